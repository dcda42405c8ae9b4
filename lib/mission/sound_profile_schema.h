#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "mission/limits.h"
#include "mission/sound_profile_config.h"

// The keys of profiles of sound speed. As in mission/schema.h.

namespace sonarsim {

inline constexpr std::array named_profiles{
    Choice<NamedProfile>{"none", NamedProfile::none},
    Choice<NamedProfile>{"isothermal", NamedProfile::isothermal},
    Choice<NamedProfile>{"mixed_layer", NamedProfile::mixed_layer},
    Choice<NamedProfile>{"summer", NamedProfile::summer}};

/// The speed of sound in water is 1,400 to 1,600 m/s; scale models in a tank may have other speeds.
inline constexpr Limits profile_speeds_m_s{1000.0, 2000.0};

template <class Visitor>
void describe(Visitor& v, ProfilePointConfig& c) {
    v.number("depth_m", c.depth_m, between(0, 12000), "depth below scene.water_surface", required);
    v.number("sound_speed_m_s", c.sound_speed_m_s, profile_speeds_m_s, "speed of sound there",
             required);
}

template <class Visitor>
void describe(Visitor& v, SoundProfileConfig& c) {
    v.choice("named", c.named, named_profiles,
             "a profile that is made from temperatures and water.salinity_psu: `isothermal` is "
             "water of water.temperature_c at all depths; `mixed_layer` has it down to 50 m and "
             "cools by 6 degrees down to 100 m, but not below 0; `summer` has 20 degrees down to 8 "
             "m and 8 degrees below 30 m");
    v.path("file", c.file, "CSV with the columns depth_m and sound_speed_m_s, in rising depth");
    v.list("points", c.points, 0,
           "the same as a list; the speed is linear between two points and constant beyond them");
    const int forms = (c.named != NamedProfile::none ? 1 : 0) + (c.file.empty() ? 0 : 1) +
                      (c.points.empty() ? 0 : 1);
    v.require(forms == 1, {"named", "file", "points"},
              "a profile of sound speed needs exactly one of 'named', 'file' and 'points'");
    const auto rises = std::ranges::adjacent_find(c.points, std::greater_equal<>(),
                                                  &ProfilePointConfig::depth_m) == c.points.end();
    v.require(rises, {"points"}, "'points' must have rising depths");
}

}  // namespace sonarsim
