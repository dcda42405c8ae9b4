#include "simulate/reference/image_error.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/sonars.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

Ping look(const Scene& scene, const Sonar& sonar, const Pose& pose) {
    return render_ping(sonar, scene, *make_rays_engine(scene), pose, {});
}

/// sum |image - expected| / sum expected over the bins where expected(i, j) >= 0.
template <class Expected>
double relative_l1(const Ping& ping, Expected expected) {
    double difference = 0.0;
    double total = 0.0;
    for (int i = 0; i < ping.range_bins; ++i) {
        for (int j = 0; j < ping.beams; ++j) {
            const double truth = expected(i, j);
            if (truth < 0.0) continue;
            difference += std::fabs(ping.at(i, j) - truth);
            total += truth;
        }
    }
    REQUIRE(total > 0.0);
    return difference / total;
}

}  // namespace

TEST_SUITE_BEGIN("sonar");

TEST_CASE("a floor below the sonar: I = R H / r in every bin, from the right bin on") {
    // Height H over a plane, pitched down by p. On the plane v . n = H / r, and the area of a
    // beam's strip is rho drho dphi = r dr dphi, so that the mean over a bin is
    // R int (H / r) r dr / int r dr = R H / r_mid exactly.
    constexpr float R = 0.6F;
    constexpr double H = 2.0;
    constexpr double pitch_deg = 25.0;
    Scene scene = empty_scene();
    add_floor(scene, 100.0F, 0.0F, add_material(scene, R));
    const Sonar sonar = noise_free(small_imaging());
    const Pose pose{rotation_from_rpy(0.0, radians(pitch_deg), 0.0), {0.0, 0.0, H}};
    const Ping ping = look(scene, sonar, pose);

    // Straight ahead the field of view reaches the floor from H / sin(p + 6) to H / sin(p - 6).
    const int middle = ping.beams / 2;
    const double first = H / std::sin(radians(pitch_deg + 6.0));
    const double last = H / std::sin(radians(pitch_deg - 6.0));
    const int first_bin = bin_at(sonar, first);
    const int last_bin = bin_at(sonar, last);
    // Half a beam off straight ahead moves the start by less than 0.03 %, 1 mm of a 37 mm bin.
    CHECK(ping.at(first_bin - 1, middle) == 0.0F);
    CHECK(ping.at(first_bin, middle) > 0.0F);
    CHECK(ping.at(last_bin, middle) > 0.0F);
    CHECK(ping.at(last_bin + 1, middle) == 0.0F);

    CHECK(relative_l1(ping, [&](int i, int j) {
              const bool inside = i > first_bin && i < last_bin && j > 24 && j < 40;
              return inside ? R * H / bin_centre(sonar, i) : -1.0;
          }) < 3e-3);
    // Wherever the whole image is occupied, whichever beam.
    CHECK(relative_l1(ping, [&](int i, int j) {
              return ping.at(i, j) > 0.0F ? R * H / bin_centre(sonar, i) : -1.0;
          }) < 0.01);
}

TEST_CASE("a sphere agrees with its closed form") {
    // Centre on the boresight at distance D, radius a. At slant range r the incidence is the same
    // all round the ring: with cos alpha = (D^2 + a^2 - r^2) / (2 D a),
    // v . n = (D cos alpha - a) / r. It falls to 0 at the horizon, r = sqrt(D^2 - a^2).
    constexpr float R = 0.9F;
    constexpr double D = 4.0;
    constexpr double a = 0.403;
    Scene scene = empty_scene();
    add_sphere(scene, {D, 0, 0}, a, add_material(scene, R), 512);
    SonarConfig config = small_imaging();
    config.azimuth_deg = 20.0;
    config.elevation_deg = 20.0;
    config.range_min_m = 3.5;
    config.range_max_m = 4.1;
    config.range_bins = 60;
    const Sonar sonar = noise_free(config, 0.01);
    const Ping ping = look(scene, sonar, Pose{});
    const int first_bin = bin_at(sonar, D - a);
    const int last_bin = bin_at(sonar, std::sqrt(D * D - a * a));
    CHECK(relative_l1(ping, [&](int i, int j) {
              const bool inside = i >= first_bin && i < last_bin - 1 && ping.at(i, j) > 0.0F;
              if (!inside) return -1.0;
              const double r = bin_centre(sonar, i);
              return R * ((D * D + a * a - r * r) / (2.0 * a) - a) / r;
          }) < 0.01);
    for (int j = 0; j < ping.beams; ++j) {
        CHECK(ping.at(first_bin - 1, j) == 0.0F);
        // At the horizon the surface runs along the ray; a bin more or less is the sampling's.
        CHECK(ping.at(last_bin + 2, j) == 0.0F);
    }
}

TEST_CASE("azimuth is positive to port, and beams run from starboard to port") {
    Scene scene = empty_scene();
    add_sphere(scene, {5, 1.5F, 0}, 0.2F, add_material(scene, 1.0F), 32);
    const Sonar sonar = noise_free(small_imaging());
    const Ping ping = look(scene, sonar, Pose{});
    const double azimuth = std::atan2(1.5, 5.0);
    int brightest = 0;
    for (int j = 0; j < ping.beams; ++j) {
        float sum = 0.0F;
        for (int i = 0; i < ping.range_bins; ++i)
            sum += ping.at(i, j);
        const bool over =
            std::fabs(0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]) -
                      azimuth) < 0.035;
        if (over) CHECK(sum > 0.0F);
        if (sum > 0.0F) brightest = j;
        if (j < ping.beams / 2) CHECK(sum == 0.0F);
    }
    CHECK(brightest > ping.beams / 2);
}

TEST_CASE("surfaces are two-sided and the impedance of water does not echo") {
    Scene scene = empty_scene();
    const std::uint32_t none = add_material(scene, 0.0F);
    const std::uint32_t some = add_material(scene, 0.5F);
    add_quad(scene, {5, -9, -9}, {5, 0, -9}, {5, 0, 9}, {5, -9, 9}, none);
    add_quad(scene, {5, 0, -9}, {5, 0, 9}, {5, 9, 9}, {5, 9, -9}, some);  // wound the other way
    const Sonar sonar = noise_free(small_imaging());
    const Ping ping = look(scene, sonar, Pose{});
    for (int j = 0; j < ping.beams; ++j) {
        float sum = 0.0F;
        for (int i = 0; i < ping.range_bins; ++i)
            sum += ping.at(i, j);
        CHECK((sum > 0.0F) == (j >= ping.beams / 2));
    }
    CHECK(power_reflection(997.0, 1480.0, {997.0, 1480.0}) == 0.0);
    // Steel in water: ((7850 * 5960 - 997 * 1480) / (their sum))^2 = 0.881.
    CHECK(power_reflection(7850.0, 5960.0, {997.0, 1480.0}) == test::approx(0.881).epsilon(1e-3));
}

TEST_CASE("a rigid motion of scene and sonar together changes nothing that can be seen") {
    const Sonar sonar = noise_free(small_imaging());
    Scene scene = tank();
    const Pose pose{rotation_from_rpy(0.02, radians(12.0), 0.1), {-3.0, -0.4, 1.4}};
    const Ping at_home = look(scene, sonar, pose);
    const Pose motion{rotation_from_rpy(0.3, -0.2, 1.1), {20.0, -7.0, 3.0}};
    for (Eigen::Vector3f& p : scene.vertices) {
        p = (motion.rotation * p.cast<double>() + motion.translation).cast<float>();
    }
    const Ping moved = look(scene, sonar, motion * pose);
    CHECK(image_error(moved.intensity, at_home.intensity).relative_l1 < 2e-3);
}

TEST_SUITE_END();
