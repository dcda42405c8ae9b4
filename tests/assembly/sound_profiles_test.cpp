#include "simulate/assembly/sound_profiles.h"

#include "support/test.h"

namespace {

/// A mission whose water has its surface at z = 3.
Mission watery(const SoundProfileConfig& profile) {
    Mission mission;
    mission.water.sound_speed_m_s = 1490.0;
    mission.scene.water_surface.emplace().height_m = 3.0;
    mission.water.profile = profile;
    return mission;
}

}  // namespace

TEST_CASE("sound profiles: depths count from the water's surface; what is wrong with a file") {
    const TemporaryFolder folder;
    const auto file = folder.path / "ctd.csv";
    write_file(file, "# cast 7\ntime,sound_speed_m_s,depth_m\na,1520,0\nb,1500,10\n");
    const SoundProfile profile = sound_profile(watery({NamedProfile::none, file}));
    CHECK(profile.speed_at(3.0) == 1520.0);
    CHECK(profile.speed_at(-2.0) == approx(1510.0));
    CHECK(profile.speed_at(-7.0) == 1500.0);
    CHECK(profile.speed_at(-50.0) == 1500.0);
    CHECK(profile.range_speed_m_s == 1490.0);
    const auto refuses = [&](const std::string& text, const std::string& why) {
        write_file(file, text);
        CHECK_THROWS_WITH_AS(sound_profile(watery({NamedProfile::none, file})),
                             doctest::Contains(why.c_str()), InputError);
    };
    refuses("depth_m,speed\n1,1500\n", "sound_speed_m_s");
    refuses("depth_m,sound_speed_m_s,depth_m\n1,1500,2\n", "'depth_m' occurs twice");
    refuses("depth_m,sound_speed_m_s\n1,1500\n1,1501\n", "greater than in the row before");
    refuses("depth_m,sound_speed_m_s\n1,150\n", "from 1000 to 2000");
    refuses("depth_m,sound_speed_m_s\n", "no rows");
}

TEST_CASE("sound profiles: the named ones follow Mackenzie's formula") {
    // Worked out by hand from the formula at 35 psu: 1521.46 at 20 degrees and the surface,
    // 1484.05 at 8 degrees and 100 m.
    const SoundProfile summer = sound_profile(watery({NamedProfile::summer, {}}));
    CHECK(summer.speed_at(3.0) == approx(1521.46).epsilon(1e-5));
    CHECK(summer.speed_at(-97.0) == approx(1484.05).epsilon(1e-5));
    // 10 degrees at all depths: only the pressure raises the speed, by 0.0163 per metre.
    const SoundProfile isothermal = sound_profile(watery({NamedProfile::isothermal, {}}));
    CHECK(isothermal.speed_at(-97.0) - isothermal.speed_at(3.0) == approx(1.632).epsilon(5e-3));
    const SoundProfile mixed = sound_profile(watery({NamedProfile::mixed_layer, {}}));
    CHECK(mixed.speed_at(-47.0) > mixed.speed_at(3.0));
    CHECK(mixed.speed_at(-97.0) < mixed.speed_at(-47.0) - 20.0);
    CHECK(std::ranges::is_sorted(mixed.height_m));
}

TEST_CASE("sound profiles: below a cold mixed layer no water is colder than 0 degrees") {
    Mission mission = watery({NamedProfile::mixed_layer, {}});
    const auto speed_at_100_m = [&](double celsius) {
        mission.water.temperature_c = celsius;
        return sound_profile(mission).speed_at(-97.0);
    };
    CHECK(speed_at_100_m(4.0) == approx(1450.592).epsilon(1e-6));   // at 0 degrees
    CHECK(speed_at_100_m(-2.0) == approx(1441.196).epsilon(1e-6));  // at -2 degrees
}

TEST_CASE("sound profiles: multipath goes straight, so it is refused") {
    Mission mission = watery({NamedProfile::summer, {}});
    mission.sensors.emplace_back().name = "fls";
    Scene scene;
    add_sound_profiles(mission, scene, {});
    CHECK(scene.sound_profile);
    mission.sensors[0].multipath.method = MultipathMethod::exact;
    CHECK_THROWS_WITH_AS(add_sound_profiles(mission, scene, {}), doctest::Contains("multipath"),
                         InputError);
}
