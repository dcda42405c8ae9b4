#include "simulate/product/soundings.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"
#include "support/test.h"

using namespace sonarsim;

namespace {

/// A flat bottom 40 m below the origin.
Scene deep_bottom() {
    return test::floor_scene(200.0F, -40.0F, 0.5F);
}

/// 1500 m/s + `gradient` z.
std::shared_ptr<const SoundProfile> linear_profile(double gradient) {
    return std::make_shared<const SoundProfile>(
        SoundProfile{{-100.0, 0.0}, {1500.0 - 100.0 * gradient, 1500.0}, 1500.0});
}

Sonar multibeam(double range_max_m, int beams, double azimuth_deg = 120.0) {
    SonarConfig config = default_sonar(SonarKind::profiling);
    config.name = "mbes";
    config.azimuth_deg = azimuth_deg;
    config.range_max_m = range_max_m;
    config.range_bins = static_cast<int>(50.0 * range_max_m);  // 2 cm
    config.azimuth_bins = beams;
    return make_sonar(config, {0.02});
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("soundings in a gradient lie on the flat bottom, by the profile of the water") {
        for (const double g : {0.5, -0.5}) {
            Scene scene = deep_bottom();
            scene.sound_profile = linear_profile(g);
            Sonar sonar = multibeam(120.0, 240);
            sonar.sound_profile = scene.sound_profile;
            const auto engine = make_engine(scene, {.type = EngineKind::rays, .octree = {}});
            const Ping ping = render_ping(sonar, scene, *engine, {}, {}, {});
            const auto soundings = find_soundings(sonar, {}, ping);
            double outermost = 0.0;
            for (std::size_t j = 0; j < soundings.size(); ++j) {
                REQUIRE(!std::isnan(soundings[j].range_m));
                const double a = std::fabs(sonar.beam_azimuths_rad[j]) - 0.5 * pi;
                // Bins of 2 cm, and beams of half a degree.
                const double slack = 0.03 + 0.03 * std::fabs(std::cos(a) / std::sin(a));
                CHECK(std::fabs(soundings[j].position.z() + 40.0) < slack);
                outermost = std::max(outermost, std::fabs(soundings[j].position.y()));
            }
            CHECK(outermost > 60.0);
        }
    }

    TEST_CASE("soundings of a sonar that rolls and drives in a ping lie on the flat bottom") {
        // In the 80 ms until the echo is back the sonar rolls by a degree, which moves a sounding
        // 50 degrees off by 0.8 m in height, and drives by 0.3 m.
        Scene scene = deep_bottom();
        Sonar sonar = multibeam(90.0, 100, 100.0);
        // In the sensor's frame, whose z axis points ahead.
        const PingMotion motion{{0.0, 0.0, 4.0}, {0.0, 0.0, radians(12.0)}, 1500.0};
        sonar.motions = std::make_shared<const std::vector<PingMotion>>(1, motion);
        for (const bool bends : {false, true}) {
            if (bends) {
                scene.sound_profile = linear_profile(-0.5);
                sonar.sound_profile = scene.sound_profile;
            }
            const auto engine = make_engine(scene, {.type = EngineKind::rays, .octree = {}});
            const Ping ping = render_ping(sonar, scene, *engine, {}, {}, {});
            int found = 0;
            for (const Sounding& sounding : find_soundings(sonar, {}, ping, motion)) {
                // Surface that enters the sector in the ping is missing.
                if (std::isnan(sounding.range_m)) continue;
                ++found;
                CHECK(std::fabs(sounding.position.z() + 40.0) < 0.15);
                CHECK(std::fabs(sounding.position.x()) < 0.01);
            }
            CHECK(found >= 98);
        }
    }
}
