#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.h"
#include "input/mission/instrument.h"
#include "input/mission/limits.h"

// The keys of the water, as in mission.h.

namespace sonarsim {

/// A layer of water that scatters more than the rest.
struct WaterLayerConfig {
    std::array<double, 2> depth_m{};  ///< top and bottom, below scene.water_surface
    double scattering_db_per_m3 = 0.0;
};

/// Profiles of sound speed that are made from temperatures, see simulate/assembly/sound_profiles.h.
enum class NamedProfile { none, isothermal, mixed_layer, summer };

/// The speed of sound by depth, in one of two forms.
struct SoundProfileConfig {
    NamedProfile named = NamedProfile::none;
    std::filesystem::path file;  ///< CSV with depth_m and sound_speed_m_s; "": none
};

struct WaterConfig {
    double density_kg_m3 = 997.0;
    double sound_speed_m_s = 1480.0;
    // The calibrated model computes absorption from these.
    double temperature_c = 10.0;
    double salinity_psu = 35.0;
    double depth_m = 10.0;
    // A gentle breeze. Above 100 kHz the noise of wind lies below that of heat.
    double wind_m_s = 5.0;
    WaterContent content = WaterContent::automatic;
    /// Volume backscattering strength, dB re 1 m^2 per m^3; empty: that of `content`.
    std::optional<double> scattering_db_per_m3 = {};
    std::vector<WaterLayerConfig> layers = {};       ///< their scattering is added to the above
    std::optional<SoundProfileConfig> profile = {};  ///< bends sound; none: paths are straight
};

/// All water scatters more than -200 dB, and every cloud of bubbles less than 0 dB.
inline constexpr Limits volume_strengths_db{-200.0, 0.0};

void describe(auto& v, WaterLayerConfig& c) {
    v.array("depth_m", c.depth_m, between(0, 12000),
            "top and bottom of the layer, below scene.water_surface", required);
    v.require(c.depth_m[0] < c.depth_m[1], {"depth_m"},
              "'depth_m' is the top and the bottom of a layer; the first must be below the second");
    v.number("scattering_db_per_m3", c.scattering_db_per_m3, volume_strengths_db,
             "volume backscattering strength, which is added to that of the water as a power",
             required);
}

inline constexpr auto named_profiles =
    choices_of<NamedProfile>("none", "isothermal", "mixed_layer", "summer");

void describe(auto& v, SoundProfileConfig& c) {
    v.choice("named", c.named, named_profiles,
             "a profile that is made from temperatures and water.salinity_psu: `isothermal` is "
             "water of water.temperature_c at all depths; `mixed_layer` has it down to 50 m and "
             "cools by 6 degrees down to 100 m, but not below 0; `summer` has 20 degrees down to 8 "
             "m and 8 degrees below 30 m");
    v.path("file", c.file, "CSV with the columns depth_m and sound_speed_m_s, in rising depth");
    v.require((c.named != NamedProfile::none) != !c.file.empty(), {"named", "file"},
              "a profile of sound speed needs either a file or a name");
}

void describe(auto& v, WaterConfig& c) {
    v.number("density_kg_m3", c.density_kg_m3, between(900, 1300), "density of the water");
    v.number("sound_speed_m_s", c.sound_speed_m_s, sound_speeds_m_s,
             "speed of sound in the water; `auto` computes it from temperature, salinity "
             "and depth by Mackenzie's formula",
             or_auto);
    v.number(
        "temperature_c", c.temperature_c, between(-2, 40),
        "temperature, for the absorption of the calibrated model and for sound_speed_m_s: auto");
    v.number("salinity_psu", c.salinity_psu, between(0, 45), "salinity, for the same");
    v.number("depth_m", c.depth_m, between(0, 12000), "depth below the surface, for the same");
    v.number("wind_m_s", c.wind_m_s, between(0, 100),
             "speed of the wind, for the noise of the sea in receiver.noise_db: auto");
    v.choice(
        "content", c.content, water_contents,
        "content of the water that scatters sound, for the calibrated model: `none` nothing, "
        "`clear` -90 dB, `coastal` -75 dB, `plankton` -65 dB, `plume` -55 dB re 1 m^2 per m^3, "
        "each with its mineral particles; `auto` is the usual_water of each instrument");
    v.number("scattering_db_per_m3", c.scattering_db_per_m3, volume_strengths_db,
             "volume backscattering strength of the water, dB re 1 m^2 per m^3, for the "
             "calibrated model; `auto` takes that of `content`");
    v.list_of("layers", c.layers, 0,
              "layers of the water that scatter more; they need scene.water_surface");
    v.section("profile", c.profile,
              "speed of sound by depth below scene.water_surface: sound bends, and a "
              "range is half of sound_speed_m_s times the time");
}

/// Speed of sound, m/s, by temperature, salinity and depth: K. V. Mackenzie, "Nine-term equation
/// for sound speed in the oceans", J. Acoust. Soc. Am. 70 (1981), 807. Made for 2 to 30 degrees, 25
/// to 40 psu, down to 8000 m; in fresh water it is too low by 1 m/s or so.
inline double sound_speed_m_s(const WaterConfig& water) {
    const double t = water.temperature_c;
    const double s = water.salinity_psu - 35.0;
    const double d = water.depth_m;
    return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * s +
           1.630e-2 * d + 1.675e-7 * d * d - 1.025e-2 * t * s - 7.139e-13 * t * d * d * d;
}

/// True if the water scatters sound back to every sonar, whatever its usual water.
inline bool scatters(const WaterConfig& water) {
    const bool has_content =
        water.content != WaterContent::none && water.content != WaterContent::automatic;
    return has_content || water.scattering_db_per_m3 || !water.layers.empty();
}

}  // namespace sonarsim
