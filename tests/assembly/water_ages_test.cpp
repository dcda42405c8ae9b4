#include "assembly/water_ages.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "core/units.h"
#include "support/approx.h"
#include "support/calibrated.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double drift_m_s = 0.004;
constexpr double sounder_hz = 38e3;
constexpr double water_level_db = -80.0;

Mission drifting_water() {
    Mission mission;
    mission.water.sound_speed_m_s = 1500.0;
    mission.water.scattering_db_per_m3 = water_level_db;
    mission.water.drift_rms_m_s = drift_m_s;
    return mission;
}

/// An echosounder of 7 degrees with bins of 0.1 m, without noise.
Sonar resting_sounder(const Mission& mission) {
    SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), sounder_hz);
    config.opening_deg = 40.0;
    config.range_min_m = 2.0;
    config.range_max_m = 22.0;
    config.range_bins = 200;
    config.instrument = bare(config.instrument);
    config.instrument.speckle.mode = SpeckleMode::scene;
    config.instrument.beam.width_deg = 7.0;
    config.instrument.pulse.resolution_m = 0.2;
    return make_sonar(config, {}, mission.water);
}

Trajectory at_rest(int pings, double interval_s) {
    Trajectory out;
    for (int k = 0; k < pings; ++k)
        out.push_back({interval_s * k, {Eigen::Quaterniond::Identity(), {0.0, 0.0, 15.0}}});
    return out;
}

/// 2 k u t of the scatterers.
double phase_spread(double time_s) {
    return 2.0 * 2.0 * pi * sounder_hz / 1500.0 * drift_m_s * time_s;
}

}  // namespace

TEST_SUITE("assembly") {
    // The power of speckle that drifts has the correlation exp(-(2 k u t)^2), that of a line array
    // of the length L that moved by d (1 - 2 d / L)^2, 0 from half of its length on.
    TEST_CASE("water ages: by time, way and turn") {
        const Mission mission = drifting_water();
        std::vector<Sonar> sonars{resting_sounder(mission)};
        Trajectory poses = at_rest(11, 0.1);
        add_water_ages(mission, poses, sonars);
        REQUIRE(sonars[0].water_ages);
        CHECK(sonars[0].water_ages->front() == 0.0);
        CHECK(sonars[0].water_ages->back() == test::approx(2.0 / pi * phase_spread(1.0)));
        // A disc or line of 7 degrees is 0.886 lambda / 0.122 long, 29 cm; the pulse is 20 cm.
        Mission frozen = mission;
        frozen.water.drift_rms_m_s = 0.0;
        poses[1].T_world_vehicle.translation.x() += 0.02;
        poses[2].T_world_vehicle = poses[1].T_world_vehicle;
        for (std::size_t k = 3; k < poses.size(); ++k)
            poses[k].T_world_vehicle = {rotation_from_rpy(0.0, 0.0, radians(0.7)),
                                        poses[2].T_world_vehicle.translation};
        poses.back().T_world_vehicle.translation.x() += 50.0;
        add_water_ages(frozen, poses, sonars);
        const std::vector<double>& ages = *sonars[0].water_ages;
        CHECK(ages[1] == test::approx(0.02 / 0.143).epsilon(0.02));
        CHECK(ages[2] == ages[1]);
        CHECK(ages[3] - ages[2] == test::approx(0.1));
        CHECK(ages[9] == ages[3]);
        CHECK(ages[10] == ages[9] + 2.0);
        // A pulse without resolution_m is as long as a sample, here 2.5 cm.
        std::vector<Sonar> sampled{resting_sounder(mission)};
        sampled[0].config.instrument.pulse.resolution_m = 0.0;
        sampled[0].config.instrument.receiver.samples = 4;
        add_water_ages(frozen, poses, sampled);
        CHECK((*sampled[0].water_ages)[1] == test::approx(0.02 / 0.025));
        // A sonar that goes with the water stays in it.
        Mission current = mission;
        current.water.current_m_s = {0.3, 0.0, -0.1};
        poses = at_rest(11, 0.1);
        for (TimedPose& pose : poses)
            pose.T_world_vehicle.translation += pose.t_s * Eigen::Vector3d(0.3, 0.0, -0.1);
        add_water_ages(current, poses, sonars);
        CHECK(sonars[0].water_ages->back() == test::approx(2.0 / pi * phase_spread(1.0)));
        // A mount that is drawn for each ping turns the sonar, here by up to 3 of its 7 degrees.
        Mission shaken = frozen;
        shaken.sensors = {sonars[0].config};
        shaken.sensors[0].name = sonars[0].config.name = "sounder";
        VaryConfig& rule = shaken.vary.emplace_back();
        rule.key = "sensors.sounder.mount.rpy_deg.0";
        rule.per = VaryPer::ping;
        rule.uniform = {-1.5, 1.5};
        sonars[0].config.every = 2;
        poses = at_rest(11, 0.1);
        add_water_ages(shaken, poses, sonars);
        const std::vector<double>& drawn = *sonars[0].water_ages;
        for (std::uint32_t k = 2; k < 11; k += 2) {
            const auto roll_deg = [&](std::uint32_t pose) {
                return drawn_sonar(shaken, sonars[0], pose)->config.mount.rpy_deg[0];
            };
            CHECK(drawn[k] - drawn[k - 2] ==
                  test::approx(std::fabs(roll_deg(k) - roll_deg(k - 2)) / 7.0));
        }
        CHECK(drawn.back() > 0.1);
        sonars[0].config.every = 1;
        // Without the key there are none.
        std::vector<Sonar> others{resting_sounder({})};
        add_water_ages({}, poses, others);
        CHECK(!others[0].water_ages);
        // Nor with speckle that is drawn for each ping.
        others[0].config.instrument.speckle.mode = SpeckleMode::ping;
        add_water_ages(mission, poses, others);
        CHECK(!others[0].water_ages);
    }

    // 30 bins of water, two resolutions apart, in 60 pings. Where pings are independent, the mean
    // of 30 correlations of 59 pairs has a deviation of 1 / sqrt(30 * 59), 0.024, and lies within
    // 0.1 (4 sigma). With an age of 2.5 pings 24 of them are independent, the deviation at most 1 /
    // sqrt(30 * 24), 0.037, and 0.15 is 4 sigma.
    TEST_CASE("water ages: a sonar at rest keeps the bottom's speckle and loses the water's") {
        Scene scene = empty_scene();
        add_floor(scene, 40.0F, 0.0F, add_material(scene, 0.4F), 4);
        const auto engine = make_engine(scene, {});
        const auto pings = [&](const Mission& mission, double interval_s) {
            std::vector<Sonar> sonars{resting_sounder(mission)};
            const Trajectory poses = at_rest(60, interval_s);
            add_water_ages(mission, poses, sonars);
            std::vector<std::vector<float>> out;
            for (std::uint32_t k = 0; k < poses.size(); ++k)
                out.push_back(render_ping(sonars[0], scene, *engine, poses[k].T_world_vehicle,
                                          {.seed = 3, .ping = k})
                                  .intensity);
            return out;
        };
        // The correlation of a bin's power in pings so many apart.
        const auto correlation = [](const std::vector<std::vector<float>>& images, int row,
                                    std::size_t lag) {
            double mean = 0.0;
            for (const auto& image : images)
                mean += image[row] / static_cast<double>(images.size());
            double power = 0.0;
            double product = 0.0;
            for (std::size_t k = 0; k < images.size(); ++k) {
                power += std::pow(images[k][row] - mean, 2) / static_cast<double>(images.size());
                if (k + lag < images.size())
                    product += (images[k][row] - mean) * (images[k + lag][row] - mean) /
                               static_cast<double>(images.size() - lag);
            }
            return power > 0.0 ? product / power : 1.0;
        };
        const auto of_water = [&](const std::vector<std::vector<float>>& images, std::size_t lag) {
            double sum = 0.0;
            for (int row = 0; row < 30; ++row)
                sum += correlation(images, 4 + 4 * row, lag) / 30.0;
            return sum;
        };
        Mission anew = drifting_water();
        anew.water.drift_rms_m_s.reset();
        const auto independent = pings(anew, 0.1);
        CHECK(std::fabs(of_water(independent, 1)) < 0.1);
        // The bottom below, from 15 to 15.5 m, is far above the water there.
        for (int row = 131; row < 136; ++row)
            CHECK(independent[59][row] == test::approx(independent[0][row]).epsilon(0.02));
        // 2 k u t = 0.64 from ping to ping, 0.4 ages: exp(-0.64^2) = 0.67.
        const auto drifting = pings(drifting_water(), 0.5);
        const double expected = std::exp(-std::pow(phase_spread(0.5), 2));
        MESSAGE("expected ", expected, ", found ", of_water(drifting, 1));
        CHECK(std::fabs(of_water(drifting, 1) - expected) < 0.15);
        CHECK(std::fabs(of_water(drifting, 6)) < 0.15);
    }
}
