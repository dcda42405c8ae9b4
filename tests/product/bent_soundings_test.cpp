#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "core/units.h"
#include "product/soundings.h"
#include "sonar/sonar.h"
#include "support/scenes.h"
#include "visibility/make_engine.h"

using namespace sonarsim;

TEST_SUITE("product") {
    TEST_CASE(
        "soundings in a gradient: truth, smile and frown of an instrument that believes in lines") {
        // The bottom is flat, 40 m below a multibeam at z = 0, and the speed is 1500 m/s + g z. A
        // beam at the elevation a reaches it at b, cos b = cos a c_b / c_0, after the time
        // (artanh(sin a) - artanh(sin b)) / g. An instrument that believes in 1500 m/s reports the
        // height 1500 time sin a. By these, where the speed falls with depth the bottom is reported
        // at -40.27 m below the sonar and at -39.5 m 60 degrees off, a smile, and where it rises at
        // -39.74 m and -40.5 m, a frown.
        for (const double g : {0.5, -0.5}) {
            Scene scene = test::empty_scene();
            const std::uint32_t material = test::add_material(scene, 0.5F);
            test::add_quad(scene, {-20.0F, -200.0F, -40.0F}, {20.0F, -200.0F, -40.0F},
                           {20.0F, 200.0F, -40.0F}, {-20.0F, 200.0F, -40.0F}, material);
            scene.sound_profile = std::make_shared<const SoundProfile>(
                SoundProfile{{-100.0, 0.0}, {1500.0 - 100.0 * g, 1500.0}, 1500.0});
            SonarConfig config = default_sonar(SonarKind::profiling);
            config.name = "mbes";
            config.range_max_m = 120.0;
            config.range_bins = 6000;
            config.azimuth_bins = 240;
            Sonar sonar = make_sonar(config, {0.02});
            sonar.true_profile = scene.sound_profile;
            const auto engine = make_engine(scene, {.type = EngineKind::rays, .octree = {}});
            const Ping ping = render_ping(sonar, scene, *engine, {}, {}, {});
            const auto reported = find_soundings(sonar, {}, ping);
            sonar.assumed_profile = scene.sound_profile;
            const auto corrected = find_soundings(sonar, {}, ping);
            double outermost = 0.0;
            for (std::size_t j = 0; j < reported.size(); ++j) {
                REQUIRE(!std::isnan(reported[j].range_m));
                const double a = std::fabs(sonar.beam_azimuths_rad[j]) - 0.5 * pi;
                const double b = -std::acos(std::cos(a) * (1500.0 - 40.0 * g) / 1500.0);
                const double time = (std::atanh(std::sin(a)) - std::atanh(std::sin(b))) / g;
                // Bins of 2 cm, and beams of half a degree.
                const double slack = 0.03 + 0.03 * std::fabs(std::cos(a) / std::sin(a));
                CHECK(std::fabs(reported[j].position.z() - 1500.0 * time * std::sin(a)) < slack);
                CHECK(std::fabs(reported[j].true_position.z() + 40.0) < slack);
                CHECK((corrected[j].position - reported[j].true_position).norm() < 1e-9);
                outermost = std::max(outermost, std::fabs(reported[j].position.y()));
            }
            CHECK(outermost > 60.0);
            const double sag = reported.front().position.z() - reported[120].position.z();
            CHECK(sag * (g > 0.0 ? 1.0 : -1.0) > 0.6);
        }
    }

    TEST_CASE("soundings of a sonar that rolls and drives in a ping lie on the flat bottom") {
        // In the 80 ms until the echo is back the sonar rolls by a degree, which moves a sounding
        // 50 degrees off by 0.8 m in height, and drives by 0.3 m.
        Scene scene = test::empty_scene();
        const std::uint32_t material = test::add_material(scene, 0.5F);
        test::add_quad(scene, {-20.0F, -200.0F, -40.0F}, {20.0F, -200.0F, -40.0F},
                       {20.0F, 200.0F, -40.0F}, {-20.0F, 200.0F, -40.0F}, material);
        SonarConfig config = default_sonar(SonarKind::profiling);
        config.name = "mbes";
        config.azimuth_deg = 100.0;
        config.range_max_m = 90.0;
        config.range_bins = 4500;
        config.azimuth_bins = 100;
        Sonar sonar = make_sonar(config, {0.02});
        // In the sensor's frame, whose z axis points ahead.
        const PingMotion motion{{0.0, 0.0, 4.0}, {0.0, 0.0, radians(12.0)}, 1500.0};
        sonar.motions = std::make_shared<const std::vector<PingMotion>>(1, motion);
        for (const bool bends : {false, true}) {
            if (bends) {
                scene.sound_profile = std::make_shared<const SoundProfile>(
                    SoundProfile{{-100.0, 0.0}, {1550.0, 1500.0}, 1500.0});
                sonar.true_profile = scene.sound_profile;
            }
            const auto engine = make_engine(scene, {.type = EngineKind::rays, .octree = {}});
            const Ping ping = render_ping(sonar, scene, *engine, {}, {}, {});
            int found = 0;
            for (const Sounding& sounding : find_soundings(sonar, {}, ping, motion)) {
                // Surface that enters the sector in the ping is missing.
                if (std::isnan(sounding.range_m)) continue;
                ++found;
                const Eigen::Vector3d& place = bends ? sounding.true_position : sounding.position;
                CHECK(std::fabs(place.z() + 40.0) < 0.15);
                CHECK(std::fabs(place.x()) < 0.01);
            }
            CHECK(found >= 98);
        }
    }
}
