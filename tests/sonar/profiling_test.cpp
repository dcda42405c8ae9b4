#include "simulate/product/bathymetry.h"
#include "simulate/product/soundings.h"
#include "simulate/reference/reference.h"
#include "support/sonars.h"

TEST_CASE("profiling: soundings lie on a flat bottom within a quarter of a range bin") {
    // The middle of a run of whole bins is off by 0.20 bins on average.
    const Scene scene = floor_scene(200.0F, 0.0F, 0.5F);
    const Sonar sonar = noise_free(default_sonar(SonarKind::profiling));
    const double bin_m = sonar.settings.view.bin_m();
    for (const double H : {8.0, 12.37, 20.02, 30.3}) {
        const Pose pose{rotation_from_rpy(0.0, 0.0, 1.0), {10.0, -5.0, H}};
        const auto soundings = find_soundings(sonar, pose, look(sonar, scene, pose));
        REQUIRE(soundings.size() == 480);
        double square = 0.0;
        double mean = 0.0;
        for (std::size_t j = 0; j < soundings.size(); ++j) {
            const double off = soundings[j].range_m - H / std::cos(sonar.beam_azimuths_rad[j]);
            square += off * off;
            mean += off;
            CHECK(soundings[j].quality == approx(1.0));
        }
        CAPTURE(H);
        CHECK(std::sqrt(square / 480.0) <= 0.25 * bin_m);
        CHECK(std::fabs(mean / 480.0) <= 0.1 * bin_m);
        // Port is at the high azimuths: with the bow at yaw 1 it lies along (-sin 1, cos 1).
        const Eigen::Vector3d port = soundings.back().position - pose.translation;
        const double reach = H * std::tan(sonar.azimuth_edges_rad[479]);
        CHECK(port.x() == approx(-std::sin(1.0) * reach).epsilon(0.02));
        CHECK(port.y() == approx(std::cos(1.0) * reach).epsilon(0.02));
        CHECK(std::fabs(port.z() + H) < 2.0 * bin_m);
    }
}

TEST_CASE("profiling: soundings on a flat bottom under noise" * doctest::skip(sanitized)) {
    // Range noise delays an echo and dims it: exp(-w / lambda) twice gives a mean of half of
    // lambda, 2 cm. Under strong additive noise some are lost, of which few may pass for good.
    const Scene scene = floor_scene(200.0F, 0.0F, 0.15F);
    for (const double add_sigma : {0.01, 0.05}) {
        SonarConfig config = default_sonar(SonarKind::profiling);
        config.range_max_m = 30.0;
        config.noise.range_lambda_m = 0.04;
        config.noise.mult_sigma = 0.15;
        config.noise.add_sigma = add_sigma;
        const Sonar sonar = make_sonar(config, {});
        double sum = 0.0;
        double near = 0.0;
        int lost = 0;
        int lost_unnoticed = 0;
        int kept = 0;
        for (std::uint32_t ping = 0; ping < 30; ++ping) {
            const double H = 12.0 + 0.0131 * ping;
            const Pose pose{.translation = {0.3 * ping, 0.0, H}};
            const auto soundings = find_soundings(sonar, pose, look(sonar, scene, pose, {1, ping}));
            for (std::size_t j = 0; j < soundings.size(); ++j) {
                const double off = soundings[j].range_m - H / std::cos(sonar.beam_azimuths_rad[j]);
                const bool is_lost = std::fabs(off) > 0.5;
                const bool passes = soundings[j].quality >= map_quality;
                lost += is_lost;
                lost_unnoticed += is_lost && passes;
                kept += !is_lost && passes;
                sum += is_lost ? 0.0 : off;
                near += is_lost ? 0.0 : 1.0;
            }
        }
        CAPTURE(add_sigma);
        CHECK(std::fabs(sum / near) < 0.5 * config.noise.range_lambda_m);
        if (add_sigma < 0.02) CHECK(lost <= 2);
        CHECK(lost_unnoticed <= 0.06 * lost);
        CHECK(kept >= 0.75 * (14400 - lost));
    }
}

TEST_CASE("profiling, side-scan, echosounder: on rough ground the error goal is met" *
          doctest::skip(sanitized)) {
    const Scene scene = rough_floor();
    const Caster caster(scene);
    const auto engine = make_rays_engine(scene);
    struct Case {
        SonarKind kind;
        double range_max_m, altitude_m;
        int range_bins, beams;
        double spread;  ///< the goal of the reference
    };
    for (const Case& one : {Case{SonarKind::profiling, 20.0, 6.0, 400, 240, 0.001},
                            {SonarKind::sidescan, 25.5, 5.02, 500, 2, 0.003},
                            {SonarKind::echosounder, 10.0, 6.0, 200, 1, 0.003}}) {
        CAPTURE(static_cast<int>(one.kind));
        SonarConfig config = default_sonar(one.kind);
        set_range(config, config.range_min_m, one.range_max_m, one.range_bins);
        config.azimuth_bins = one.beams;
        const Sonar sonar = noise_free(config);
        const Pose pose{rotation_from_rpy(0.02, -0.01, 0.4), {0.3, -0.2, one.altitude_m}};
        const Reference reference = cast_reference(
            caster, scene, sonar.settings.view, pose * sonar.T_vehicle_sensor, {one.spread, 64.0});
        const Ping ping = render_ping(sonar, scene, *engine, pose, {});
        CHECK(image_error(ping.intensity, reference.intensity).relative_l1 < 0.03);
    }
}
