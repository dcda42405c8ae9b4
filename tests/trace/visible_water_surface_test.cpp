#include "simulate/trace/visible_water_surface.h"

#include "simulate/reference/reference.h"
#include "support/bounces.h"
#include "support/calibrated.h"
#include "support/patches.h"

namespace {

constexpr double surface_m = 5.0;

View view_to_surface(ViewShape shape, double azimuth_deg, double elevation_deg) {
    return with_shape({radians(azimuth_deg), radians(elevation_deg), 0.5, 40.0, 800, 64, 0.03},
                      shape);
}

/// The area of the surface between two ranges, m^2.
double area_between(Scene scene, const View& view, const Pose& pose, double from_m, double to_m) {
    const auto engine = make_rays_engine(scene);
    scene.water_surface = WaterSurface{surface_m, 1.0F, 5.0};
    double sum = 0.0;
    Samples visible;
    ScatteringSurface().add({view, scene, *engine, pose}, {}, 0, visible);
    for (const Sample& sample : visible.items) {
        CHECK(sample.material == scene.materials.size());
        const double range = sample.position.norm();
        CHECK(sample.height_m == approx(surface_m - pose.translation.z()));
        CHECK(-sample.normal.dot(sample.position) == approx(sample.height_m).epsilon(1e-3));
        // The share of the sample's depth that lies between the two.
        const Eigen::Vector3f towards = sample.position.normalized();
        const double half =
            std::fabs(towards.dot(sample.edge_u)) + std::fabs(towards.dot(sample.edge_v)) + 1e-6;
        const double within = std::min(range + half, to_m) - std::max(range - half, from_m);
        sum += sample.area_m2 * std::max(0.0, within) / (2.0 * half);
    }
    return sum;
}

Scene scene_below() {
    return floor_scene(100.0F, -50.0F, 0.4F, 4);
}

}  // namespace

// Within a cone of the half angle a, straight up, lies a disc of the radius h tan a.
TEST_CASE("water's surface: a cone that looks up sees a disc") {
    const Pose up = pitched(-90.0);
    for (const double opening_deg : {7.0, 30.0, 60.0}) {
        CAPTURE(opening_deg);
        const double radius = surface_m * std::tan(radians(0.5 * opening_deg));
        const View view = view_to_surface(ViewShape::cone, opening_deg, opening_deg);
        CHECK(area_between(scene_below(), view, up, 0.0, 40.0) ==
              approx(pi * radius * radius).epsilon(0.035));
    }
}

// Between the ranges r and s, and over the azimuth f about the vertical, lies the area
// f / 2 (s^2 - r^2): the squares of horizontal and slant range differ by that of the height.
TEST_CASE("water's surface: a fan that looks ahead sees a part of a ring") {
    const View view = view_to_surface(ViewShape::fan, 60.0, 40.0);
    for (const double from_m : {16.0, 25.0}) {
        const double to_m = 1.3 * from_m;
        CHECK(area_between(scene_below(), view, {}, from_m, to_m) ==
              approx(0.5 * radians(60.0) * (to_m * to_m - from_m * from_m)).epsilon(0.03));
    }
}

// Along the track lies an elevation e to either side: over a range dr the strips of both sides have
// the area 4 sin(e) r^2 dr / y, y the horizontal distance. The second case is at a grazing angle.
TEST_CASE("water's surface: a side-scan sonar sees it above") {
    struct Case {
        double below_m, from_m, to_m;
        int bins;
    };
    for (const Case& c : {Case{5.0, 8.0, 30.0, 800}, Case{1.0, 80.0, 100.0, 4000}}) {
        View view = view_to_surface(ViewShape::port_starboard, 170.0, 2.0);
        view.range_max_m = std::max(40.0, c.to_m);
        view.range_bins = c.bins;
        const Pose down = pitched(90.0, {0.0, 0.0, surface_m - c.below_m});
        // The integral of r^2 dr / sqrt(r^2 - h^2).
        const auto integral = [&](double r) {
            const double y = std::sqrt(r * r - c.below_m * c.below_m);
            return 0.5 * (r * y + c.below_m * c.below_m * std::log(r + y));
        };
        CHECK(area_between(c.below_m < 2.0 ? empty_scene() : scene_below(), view, down, c.from_m,
                           c.to_m) ==
              approx(4.0 * std::sin(radians(1.0)) * (integral(c.to_m) - integral(c.from_m)))
                  .epsilon(0.03));
    }
}

TEST_CASE("water's surface: what hides it, and a sonar above it") {
    Scene scene = scene_below();
    add_floor(scene, 50.0F, 3.0F, 0);
    const View view = view_to_surface(ViewShape::fan, 60.0, 40.0);
    CHECK(area_between(scene, view, {}, 0.0, 40.0) == 0.0);
    CHECK(area_between(scene_below(), view, pitched(-90.0, {0.0, 0.0, 6.0}), 0.0, 40.0) == 0.0);
}

TEST_CASE("water surface: a wall ends there, for every engine and for the reference") {
    Scene scene = rectangle_scene({5, -1, -2}, {5, 1, 2}, 0.5F);
    scene.bounds_max = {5, 1, 2};
    SonarConfig config = small_imaging();
    config.elevation_deg = 80.0;
    const Sonar sonar = noise_free(config);
    for (const double top_m : {-0.7, 0.3}) {
        scene.water_surface = WaterSurface{top_m};
        const Pose pose{.translation = {0.0, 0.0, -1.0}};
        const Reference truth = cast_reference(Caster(scene), scene, sonar.settings.view,
                                               sensor_pose(sonar, pose, 0), {0.003, 16.0, 400'000});
        for (const EngineKind kind : {EngineKind::rays, EngineKind::strips}) {
            const TracedPing traced = trace(sonar, scene, *engine_of(scene, kind), pose, 0);
            CHECK(area_of(traced.samples) == approx(2.0 * (top_m + 2.0)).epsilon(0.02));
            CHECK(error_without_noise(expected_image(sonar, scene, kind, pose), truth) < 0.03);
        }
    }
}

TEST_CASE("water surface: the second bottom echo of an echosounder and of a side-scan sonar") {
    // Sound goes down, up to the surface d above, down to the bottom h below, and up: half of
    // that, 2 h + d, is the range at nadir. Off nadir by an angle a, in the unfolded world, the
    // second point lies x = (3 h + 2 d) tan a aside, so that the range is
    // ((3 h + 2 d) / cos a + sqrt(h^2 + x^2)) / 2.
    constexpr double h = 5.0;
    constexpr double d = 2.0;
    Scene scene = floor_scene(50.0F, 0.0F, 0.25F, 4);
    scene.water_surface = {h + d, 0.9F};
    const View view{radians(30.0), radians(30.0), 0.5, 20.0, 400, 1, 0.03, ViewShape::cone};
    const View sides = with_shape({radians(120.0), radians(4.0), 0.5, 20.0, 400, 2, 0.03},
                                  ViewShape::port_starboard);
    const Pose down = pitched(90.0, {0.0, 0.0, h});
    for (const auto& trial : {std::pair{view, 0}, {view, 5}, {sides, 0}, {sides, 5}}) {
        const View& of = trial.first;
        const int epsilon = trial.second;
        CAPTURE_ALL(static_cast<int>(of.shape), epsilon);
        const auto found = find(scene, of, clusters_of(epsilon), down);
        REQUIRE(found.bounces.size() > 10);
        std::vector<float> nearest(of.beams, 1e9F);
        for (const BouncePath& b : found.bounces) {
            const Eigen::Vector3d p = found.samples.items[b.sample].position.cast<double>();
            // x along the boresight is down: the angle off nadir is that off x.
            const double tangent = std::hypot(p.y(), p.z()) / p.x();
            const double way = 3.0 * h + 2.0 * d;
            const double range =
                0.5 * (way * std::sqrt(1.0 + tangent * tangent) + std::hypot(h, way * tangent));
            CHECK(std::fabs(b.range_m - range) < 1e-3);
            float& own = nearest[static_cast<std::size_t>(b.beam)];
            own = std::min(own, b.range_m);
            // R_b, R_s, R_b and the cosine of a mirror: q . v of the last leg.
            CHECK(b.intensity < 0.25F * 0.9F * 0.25F + 1e-6F);
        }
        for (const float own : nearest)
            CHECK(std::fabs(own - (2.0 * h + d)) < (of.shape == ViewShape::cone ? 0.02 : 0.5));
    }
    // Without a surface nothing comes back, and a sonar above it hears nothing of it.
    scene.water_surface.reset();
    CHECK(find(scene, view, clusters_of(0), down).bounces.empty());
    scene.water_surface = {1.0, 0.9F};
    CHECK(find(scene, view, clusters_of(0), down).bounces.empty());
}

TEST_CASE("water surface: the ghost of a wall in the surface") {
    // The sonar looks along x, level, at a wall at x = 6; the surface is 1 m above. Sound goes
    // over the wall to the surface and straight back: the mirror image of the sonar in the
    // wall is at (12, 0, 0), and p is where the line from there meets the surface.
    Scene scene = rectangle_scene({6, -9, -9}, {6, 9, 9}, 0.5F, 4);
    scene.water_surface = {1.0, 0.8F};
    View view = fan(60.0, 60.0);
    view.range_max_m = 12.0;
    const auto found = find(scene, view, clusters_of(0), {});
    int ghosts = 0;
    for (const BouncePath& b : found.bounces) {
        const Eigen::Vector3d p_i = found.samples.items[b.sample].position.cast<double>();
        const Eigen::Vector3d image(12, 0, 0);
        const Eigen::Vector3d r = p_i - image;
        if (!(r.z() > 0.05)) continue;
        const Eigen::Vector3d p = image + (1.0 / r.z()) * r;
        if (p.x() > 5.99) continue;  // on the far side of the wall
        const double range = 0.5 * ((p - image).norm() + p.norm());
        if (std::fabs(b.range_m - range) > 1e-3) continue;  // an echo over the mirror
        ++ghosts;
        const double cosine =
            -(r - 2.0 * r.z() * Eigen::Vector3d::UnitZ()).normalized().dot(p.normalized());
        CHECK(std::fabs(b.intensity / (0.5 * 0.8 * cosine) - 1.0) < 1e-3);
    }
    CHECK(ghosts > 20);
}
