#include "simulate/water/water_ray.h"

#include "support/test.h"

namespace {

/// A warm layer over a thermocline over cold water.
SoundProfile summer_water() {
    return {{-200.0, -30.0, -8.0, 0.0}, {1483.5, 1480.8, 1521.6, 1521.5}, 1500.0};
}

/// A ray's x, z, angle and time by its equations dx = cos, dz = sin, d(angle) = -c' cos / c,
/// dt = 1 / c by the length, in steps of the classical Runge-Kutta method. Independent of arcs.
Eigen::Vector4d integrated(const SoundProfile& profile, Eigen::Vector4d at, double length,
                           int steps) {
    const auto rate = [&](const Eigen::Vector4d& g) -> Eigen::Vector4d {
        const double c = profile.speed_at(g[1]);
        const double slope = profile.gradient(profile.layer_of(g[1]));
        return {std::cos(g[2]), std::sin(g[2]), -slope * std::cos(g[2]) / c, 1.0 / c};
    };
    const double h = length / steps;
    for (int k = 0; k < steps; ++k) {
        const Eigen::Vector4d a = rate(at);
        const Eigen::Vector4d b = rate(at + 0.5 * h * a);
        const Eigen::Vector4d c = rate(at + 0.5 * h * b);
        const Eigen::Vector4d d = rate(at + h * c);
        at += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    return at;
}

WaterRay after(const SoundProfile& profile, WaterRay ray, double length) {
    while (length > 1e-9)
        length -= advance(profile, length, ray);
    return ray;
}

}  // namespace

TEST_CASE("place, time and direction are those of a numerical integration across layers") {
    const SoundProfile profile = summer_water();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> elevations(-1.4, 1.4);
    std::uniform_real_distribution<double> depths(1.0, 150.0);
    for (int k = 0; k < 40; ++k) {
        const double elevation = elevations(random);
        const double z = -depths(random);
        const WaterRay ray = after(profile, water_ray(profile, z, elevation), 300.0);
        const auto there = integrated(profile, {0.0, z, elevation, 0.0}, 300.0, 60000);
        // The integration does not see where within a step a layer ends.
        CHECK(ray.along_m == approx(there[0]).epsilon(1e-5));
        CHECK(std::fabs(ray.height_m - there[1]) < 2e-3);
        CHECK(ray.time_s == approx(there[3]).epsilon(1e-6));
    }
}

TEST_CASE("reciprocity: the way back is the way there, and its tube widens alike") {
    // A neighbour's distance across is c_A times a number that is the same both ways.
    const SoundProfile profile = summer_water();
    std::mt19937 random(6);
    std::uniform_real_distribution<double> elevations(-1.3, -0.35);
    for (int k = 0; k < 40; ++k) {
        const double elevation = elevations(random);
        const WaterRay there = after(profile, water_ray(profile, -2.0, elevation), 150.0);
        // Turned about the vertical, so that it goes to greater x as well.
        const WaterRay back =
            after(profile, water_ray(profile, there.height_m, -there.elevation_rad), 150.0);
        CHECK(std::fabs(back.along_m - there.along_m) < 1e-6);
        CHECK(std::fabs(back.height_m + 2.0) < 1e-6);
        CHECK(back.time_s == approx(there.time_s).epsilon(1e-11));
        CHECK(back.tube_m * profile.speed_at(there.height_m) ==
              approx(there.tube_m * profile.speed_at(-2.0)).epsilon(1e-6));
    }
}

// S. M. Reilly's WaveQ3D (UnderSeaModelingLibrary, waveq3d/test/refraction_test.cc) lists the
// cycles of rays that leave a depth of 1,000 m in Munk's profile (J. Acoust. Soc. Am. 55
// (1974), 220), on a sphere of the radius R. With z = R log(R / r) and x = R angle rays go as
// over flat ground, and distances at the source's depth are by (R - 1000) / R shorter. Nodes
// every 0.25 m leave 4e-6 of a cycle at 1 degree, and less at the others.
TEST_CASE("rays in Munk's profile have the cycles that WaveQ3D lists") {
    constexpr double radius_m = 6378101.03;
    const auto flattened = [](double depth) { return radius_m * std::log(1.0 - depth / radius_m); };
    const double start_m = flattened(1000.0);
    SoundProfile munk;
    for (int k = 20000; k >= 0; --k) {
        const double depth = 0.25 * k;
        const double y = 2.0 * (depth - 1300.0) / 1300.0;
        munk.height_m.push_back(flattened(depth));
        munk.speed_m_s.push_back(1500.0 * (1.0 + 0.00737 * (y - 1.0 + std::exp(-y))));
    }
    const auto cycle_of = [&](double degrees) {
        WaterRay ray = water_ray(munk, start_m, radians(degrees));
        const bool rises = degrees > 0.0;
        WaterRay before = ray;
        const auto is_back = [&] {
            const bool crosses = rises ? before.height_m < start_m && ray.height_m >= start_m
                                       : before.height_m > start_m && ray.height_m <= start_m;
            return crosses && before.along_m > 1.0;
        };
        while (!is_back()) {
            before = ray;
            advance(munk, 1.0, ray);
        }
        const double share = (start_m - before.height_m) / (ray.height_m - before.height_m);
        const double along = before.along_m + share * (ray.along_m - before.along_m);
        return along * (radius_m - 1000.0) / radius_m;
    };
    const std::pair<double, double> listed[] = {{1.0, 48161.238557},  {2.0, 48412.185973},
                                                {5.0, 50189.572079},  {8.0, 53559.948084},
                                                {11.0, 58539.834823}, {14.0, 64977.771509}};
    for (const auto& known : listed) {
        for (const double side : {1.0, -1.0})
            CHECK(cycle_of(side * known.first) == approx(known.second).epsilon(1e-5));
    }
}

TEST_CASE("a tube is as wide as neighbouring rays are apart") {
    const SoundProfile profile = summer_water();
    constexpr double turn = 1e-6;
    for (const double elevation : {-1.2, -0.7, -0.4, -0.05, 0.1}) {
        const WaterRay ray = after(profile, water_ray(profile, -20.0, elevation), 60.0);
        const WaterRay other = after(profile, water_ray(profile, -20.0, elevation + turn), 60.0);
        const double apart = (other.height_m - ray.height_m) * std::cos(ray.elevation_rad) -
                             (other.along_m - ray.along_m) * std::sin(ray.elevation_rad);
        CHECK(ray.tube_m == approx(apart / turn).epsilon(1e-3));
    }
}

TEST_CASE("a place by range and direction, and level rays at a node end") {
    // In a gradient of 0.3 / s, from the elevation a to b.
    const SoundProfile profile{{-1000.0, 0.0}, {1200.0, 1500.0}, 1500.0};
    const double a = radians(-50.0);
    const double b = radians(-52.0);
    const double time = (std::atanh(std::sin(a)) - std::atanh(std::sin(b))) / 0.3;
    const double x = 1500.0 / (0.3 * std::cos(a)) * (std::sin(a) - std::sin(b));
    const double z = (1500.0 * std::cos(b) / std::cos(a) - 1500.0) / 0.3;
    const double azimuth = 0.6;
    const Eigen::Vector3d direction(std::cos(a) * std::cos(azimuth),
                                    std::cos(a) * std::sin(azimuth), std::sin(a));
    const Eigen::Vector3d place = place_of(profile, {100.0, -50.0, 0.0}, direction, 1500.0 * time);
    CHECK(place.x() == approx(100.0 + x * std::cos(azimuth)).epsilon(1e-9));
    CHECK(place.y() == approx(-50.0 + x * std::sin(azimuth)).epsilon(1e-9));
    CHECK(place.z() == approx(z).epsilon(1e-8));
    // From the height of a node, rays bend by the layer that they lead into.
    const SoundProfile valley{{-100.0, -50.0, 0.0}, {1520.0, 1480.0, 1520.0}, 1500.0};
    const WaterRay down = after(valley, water_ray(valley, -50.0, -0.3), 60.0);
    const WaterRay up = after(valley, water_ray(valley, -50.0, 0.3), 60.0);
    CHECK(down.height_m + up.height_m == approx(-100.0).epsilon(1e-12));
    CHECK(down.time_s == approx(up.time_s).epsilon(1e-12));
    CHECK(valley.speed_at(down.height_m) > 1490.0);
    // A level ray stays at the node of the least speed.
    const Eigen::Vector3d far = place_of(valley, {0.0, 0.0, -50.0}, {1.0, 0.0, 0.0}, 15000.0);
    CHECK(far.x() == approx(14800.0).epsilon(1e-4));
    CHECK(std::fabs(far.z() + 50.0) < 0.5);
}

TEST_CASE("water ray: apparent places are the inverse of true ones, with their rays' spread") {
    // In a constant gradient g a ray of the elevation a, cos(a) / c constant, has gone the distance
    // c (sin a - sin b) / (g cos a) where its elevation is b. Sound that spreads over W X / cos(a)
    // for each solid angle, W = |dX / da sin b| at one height, has the power of range^2 by that.
    constexpr double g = 0.1;
    const SoundProfile profile{{-500.0, 500.0}, {1500.0 - 500.0 * g, 1500.0 + 500.0 * g}, 1480.0};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int trial = 0; trial < 30; ++trial) {
        const Eigen::Vector3d source(1e5, -2e5, 20.0 * unit(random));
        const double azimuth = 2.0 * pi * unit(random);
        const Eigen::Vector3d place =
            source + Eigen::Vector3d((20.0 + 150.0 * unit(random)) * std::cos(azimuth),
                                     (20.0 + 150.0 * unit(random)) * std::sin(azimuth),
                                     -20.0 - 40.0 * unit(random));
        const auto found = apparent_place(profile, source, place).value();
        const double range = found.apparent.norm();
        const Eigen::Vector3d direction = found.apparent / range;
        CHECK((place_of(profile, source, direction, range) - place).norm() < 1e-4);
        const double a = std::asin(direction.z());
        const double c = profile.speed_at(source.z());
        const double there = profile.speed_at(place.z());
        const auto b_of = [&](double e) { return -std::acos(std::cos(e) * there / c); };
        const auto distance = [&](double e) {
            return c / (g * std::cos(e)) * (std::sin(e) - std::sin(b_of(e)));
        };
        const double across =
            std::fabs((distance(a + 1e-5) - distance(a - 1e-5)) / 2e-5 * std::sin(b_of(a)));
        const double share = range * range * std::cos(a) / (across * distance(a));
        CHECK(found.strength == approx(share * share).epsilon(2e-3));
        // The direction of arrival at the place, as it appears.
        Eigen::Vector3d arrives = place - source;
        arrives.z() = 0.0;
        arrives = std::cos(b_of(a)) * arrives.normalized();
        arrives.z() = std::sin(b_of(a));
        CHECK((found.R * arrives - direction).norm() < 1e-3);
    }
}
