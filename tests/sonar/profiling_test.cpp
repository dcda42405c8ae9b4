#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "core/units.h"
#include "product/bathymetry.h"
#include "product/soundings.h"
#include "sonar/kinds.h"
#include "sonar/sonar.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "validation/image_error.h"
#include "validation/reference.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

SonarConfig profiling() {
    SonarConfig config = default_sonar(SonarKind::profiling);
    config.name = "mbes";
    return config;
}

struct Spread {
    double bias_m;
    double rms_m;
};

/// The heights of the soundings of a straight pass above the surface below them.
Spread heights_of_a_pass(const Scene& scene, const Sonar& sonar) {
    const auto engine = make_rays_engine(scene);
    double sum = 0.0;
    double square = 0.0;
    double count = 0.0;
    for (std::uint32_t ping = 0; ping < 20; ++ping) {
        const Pose pose{rotation_from_rpy(0.02, -0.01, 0.4), {0.1 * ping, 0.05 * ping, 6.0}};
        const Ping echo = render_ping(sonar, scene, *engine, pose, {7, ping});
        for (const Sounding& sounding : find_soundings(sonar, pose, echo)) {
            if (std::isnan(sounding.range_m)) continue;
            const Eigen::Vector3d above(sounding.position.x(), sounding.position.y(), 50.0);
            const Ray down{Eigen::Vector3f::Zero(), -Eigen::Vector3f::UnitZ()};
            Intersection hit{};
            engine->intersect({Eigen::Quaterniond::Identity(), above}, {&down, 1}, {&hit, 1});
            const double off = sounding.position.z() - (above.z() - hit.distance_m);
            sum += off;
            square += off * off;
            ++count;
        }
    }
    REQUIRE(count > 4000.0);
    return {sum / count, std::sqrt(square / count)};
}

}  // namespace

TEST_SUITE_BEGIN("sonar");

TEST_CASE("profiling: soundings lie on a flat bottom within a quarter of a range bin") {
    // Without noise all bins that the bottom touches are equally bright, so the middle of the run
    // is that of whole bins. Were the ends of the footprint evenly spread over the bins, that would
    // be off by sqrt((1 - f)^3 + f^3) / sqrt(12) bins for a footprint of f bins, 0.20 on average.
    Scene scene = empty_scene();
    add_floor(scene, 200.0F, 0.0F, add_material(scene, 0.5F));
    const auto engine = make_rays_engine(scene);
    const Sonar sonar = noise_free(profiling());
    const double bin_m = sonar.settings.view.bin_m();
    for (const double H : {8.0, 12.37, 20.02, 30.3}) {
        const Pose pose{rotation_from_rpy(0.0, 0.0, 1.0), {10.0, -5.0, H}};
        const Ping ping = render_ping(sonar, scene, *engine, pose, {});
        const std::vector<Sounding> soundings = find_soundings(sonar, pose, ping);
        REQUIRE(soundings.size() == 480);
        double square = 0.0;
        double mean = 0.0;
        for (std::size_t j = 0; j < soundings.size(); ++j) {
            const double azimuth =
                0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]);
            const double off = soundings[j].range_m - H / std::cos(azimuth);
            square += off * off;
            mean += off;
            CHECK(soundings[j].quality == test::approx(1.0));
        }
        CAPTURE(H);
        CHECK(std::sqrt(square / 480.0) <= 0.25 * bin_m);
        CHECK(std::fabs(mean / 480.0) <= 0.1 * bin_m);
        // Port is at the high azimuths: with the bow at yaw 1 it lies along (-sin 1, cos 1).
        const Eigen::Vector3d port = soundings.back().position - pose.translation;
        const double reach = H * std::tan(sonar.azimuth_edges_rad[479]);
        CHECK(port.x() == test::approx(-std::sin(1.0) * reach).epsilon(0.02));
        CHECK(port.y() == test::approx(std::cos(1.0) * reach).epsilon(0.02));
        CHECK(std::fabs(port.z() + H) < 2.0 * bin_m);
    }
}

TEST_CASE("profiling: soundings on a flat bottom under noise" * doctest::skip(test::sanitized)) {
    // 12 m up, bins of 3.9 cm. Range noise delays an echo by 4 cm on average with a weight that falls
    // as the delay grows: exp(-w / lambda) twice gives a mean of half of lambda, so the bias lies
    // between none and 2 cm. Under strong additive noise some are lost, of which few may pass for
    // good.
    Scene scene = empty_scene();
    add_floor(scene, 200.0F, 0.0F, add_material(scene, 0.15F));
    const auto engine = make_rays_engine(scene);
    for (const double add_sigma : {0.01, 0.05}) {
        SonarConfig config = profiling();
        config.range_max_m = 30.0;
        config.noise.range_lambda_m = 0.04;
        config.noise.mult_sigma = 0.15;
        config.noise.add_sigma = add_sigma;
        const Sonar sonar = make_sonar(config, {});
        std::array<double, 4> sum{};
        std::array<double, 4> count{};
        int lost = 0;
        int lost_unnoticed = 0;
        int kept = 0;
        for (std::uint32_t ping = 0; ping < 30; ++ping) {
            const double H = 12.0 + 0.0131 * ping;
            const Pose pose{Eigen::Quaterniond::Identity(), {0.3 * ping, 0.0, H}};
            const std::vector<Sounding> soundings =
                find_soundings(sonar, pose, render_ping(sonar, scene, *engine, pose, {1, ping}));
            for (std::size_t j = 0; j < soundings.size(); ++j) {
                const double azimuth =
                    0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]);
                const double off = soundings[j].range_m - H / std::cos(azimuth);
                const bool passes = soundings[j].quality >= map_quality;
                if (std::fabs(off) > 0.5) {
                    ++lost;
                    lost_unnoticed += passes;
                    continue;
                }
                kept += passes;
                const auto group = static_cast<std::size_t>(std::fabs(azimuth) / radians(15.001));
                sum[group] += off;
                ++count[group];
            }
        }
        CAPTURE(add_sigma);
        MESSAGE("additive noise " << add_sigma << ": " << lost << " of 14400 lost, of which "
                                  << lost_unnoticed << " pass; " << kept << " good ones pass");
        for (std::size_t group = 0; group < 4; ++group) {
            const double bias = sum[group] / count[group];
            MESSAGE("from " << 15 * group << " degrees: " << 100.0 * bias << " cm");
            CHECK(std::fabs(bias) < 0.5 * config.noise.range_lambda_m);
        }
        if (add_sigma < 0.02) CHECK(lost <= 2);
        CHECK(lost_unnoticed <= 0.06 * lost);
        CHECK(kept >= 0.75 * (14400 - lost));
    }
}

TEST_CASE("profiling: on rough ground the error goal is met, and soundings have no bias" *
          doctest::skip(test::sanitized)) {
    const Scene scene = rough_floor();
    const Caster caster(scene);
    SonarConfig config = profiling();
    config.range_max_m = 20.0;
    config.range_bins = 400;
    config.azimuth_bins = 240;
    const Sonar sonar = noise_free(config);
    const Pose pose{rotation_from_rpy(0.02, -0.01, 0.4), {0.3, -0.2, 6.0}};
    const Reference reference = cast_reference(caster, scene, sonar.settings.view,
                                               pose * sonar.T_vehicle_sensor, {0.005, 64.0});
    const auto engine = make_rays_engine(scene);
    const Ping ping = render_ping(sonar, scene, *engine, pose, {});
    CHECK(image_error(ping.intensity, reference.intensity).relative_l1 < 0.03);

    // The truth of a beam is the range along its centre.
    const Pose T_world_sensor = pose * sonar.T_vehicle_sensor;
    double bias = 0.0;
    const std::vector<Sounding> soundings = find_soundings(sonar, pose, ping);
    for (std::size_t j = 0; j < soundings.size(); ++j) {
        const double azimuth = 0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]);
        const Ray ray{Eigen::Vector3f::Zero(),
                      Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0).cast<float>()};
        Intersection hit{};
        engine->intersect(T_world_sensor, {&ray, 1}, {&hit, 1});
        bias += soundings[j].range_m - hit.distance_m;
    }
    bias /= static_cast<double>(soundings.size());
    CHECK(std::fabs(bias) <= 0.1 * sonar.settings.view.bin_m());
}

TEST_CASE("profiling: the depths of a pass over rough ground, without and with noise") {
    // Range noise only ever adds, but what it delays it dims: the peak stays where it was.
    const Scene scene = rough_floor();
    SonarConfig config = profiling();
    config.range_max_m = 20.0;
    config.range_bins = 400;
    config.azimuth_bins = 240;
    const double bin_m = noise_free(config).settings.view.bin_m();
    const Spread clean = heights_of_a_pass(scene, noise_free(config));
    config.noise = {0.04, 0.02, 0.01, 0.15, true, 0.0};  // as in configs/seafloor_bathymetry.yaml
    const Spread noisy = heights_of_a_pass(scene, make_sonar(config, {0.03}));
    MESSAGE("bins of " << bin_m << " m; noise-free: bias " << clean.bias_m << " m, RMS "
                       << clean.rms_m << " m; with noise: bias " << noisy.bias_m << " m, RMS "
                       << noisy.rms_m << " m");
    CHECK(std::fabs(clean.bias_m) <= 0.1 * bin_m);
    CHECK(clean.rms_m <= 0.5 * bin_m);
    CHECK(std::fabs(noisy.bias_m) <= 0.1 * bin_m);
    CHECK(noisy.rms_m <= bin_m);
}

TEST_SUITE_END();
