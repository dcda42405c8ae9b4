#pragma once

#include <filesystem>
#include <vector>

namespace sonarsim {

/// Profiles of sound speed that are made from temperatures, see assembly/sound_profiles.h.
enum class NamedProfile { none, isothermal, mixed_layer, summer };

/// The speed of sound at a depth below scene.water_surface.
struct ProfilePointConfig {
    double depth_m = 0.0;
    double sound_speed_m_s = 0.0;

    bool operator==(const ProfilePointConfig&) const = default;
};

/// The speed of sound by depth, in one of three forms.
struct SoundProfileConfig {
    NamedProfile named = NamedProfile::none;
    std::filesystem::path file;              ///< CSV with depth_m and sound_speed_m_s; "": none
    std::vector<ProfilePointConfig> points;  ///< in rising depth

    bool operator==(const SoundProfileConfig&) const = default;
};

}  // namespace sonarsim
