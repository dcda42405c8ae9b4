#pragma once

#include <array>

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
void describe(Visitor& v, SoundProfileConfig& c) {
    v.choice("named", c.named, named_profiles,
             "a profile that is made from temperatures and water.salinity_psu: `isothermal` is "
             "water of water.temperature_c at all depths; `mixed_layer` has it down to 50 m and "
             "cools by 6 degrees down to 100 m, but not below 0; `summer` has 20 degrees down to 8 "
             "m and 8 degrees below 30 m");
    v.path("file", c.file, "CSV with the columns depth_m and sound_speed_m_s, in rising depth");
    v.require((c.named != NamedProfile::none) != !c.file.empty(), {"named", "file"},
              "a profile of sound speed needs exactly one of 'named' and 'file'");
}

}  // namespace sonarsim
