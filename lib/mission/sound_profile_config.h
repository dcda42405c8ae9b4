#pragma once

#include <filesystem>

namespace sonarsim {

/// Profiles of sound speed that are made from temperatures, see assembly/sound_profiles.h.
enum class NamedProfile { none, isothermal, mixed_layer, summer };

/// The speed of sound by depth, in one of two forms.
struct SoundProfileConfig {
    NamedProfile named = NamedProfile::none;
    std::filesystem::path file;  ///< CSV with depth_m and sound_speed_m_s; "": none

    bool operator==(const SoundProfileConfig&) const = default;
};

}  // namespace sonarsim
