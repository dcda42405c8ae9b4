#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "input/mission/instrument.h"
#include "input/mission/limits.h"

// The keys of the water and of scene.particles, as in mission.h.

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
              "a profile of sound speed needs exactly one of 'named' and 'file'");
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

enum class ParticleKind { points, fish, bubbles };
enum class ParticleRegion { box, ellipsoid };

/// Point targets in the water. Pairs are limits of uniform draws.
struct ParticlesConfig {
    std::string name;                            ///< the targets are NAME_1, NAME_2, ...
    std::string class_name;                      ///< "": the name
    std::array<double, 2> target_strength_db{};  ///< points; dB re 1 m^2
    std::array<double, 2> length_m{};            ///< fish; 0: none
    std::array<double, 2> radius_m{};            ///< bubbles; 0: none
    std::array<double, 2> count{};
    ParticleRegion region = ParticleRegion::box;
    std::array<double, 3> position_m{};  ///< middle of the region, world
    std::array<double, 3> size_m{};      ///< from end to end along x, y and z
    std::array<double, 3> drift_m_s{};
    double rise_m_s = 0.0;  ///< for bubbles, which come back at the bottom of the region
    Location place = {};

    ParticleKind kind() const {
        return length_m[0] > 0.0   ? ParticleKind::fish
               : radius_m[0] > 0.0 ? ParticleKind::bubbles
                                   : ParticleKind::points;
    }
};

/// The most particles of a group.
inline constexpr double max_particles = 1e6;
/// Larger groups are one object of the labels each.
inline constexpr double max_single_particles = 100;

inline constexpr auto particle_regions = choices_of<ParticleRegion>("box", "ellipsoid");

/// From a grain of dust to a ship.
inline constexpr Limits target_strengths_db{-200.0, 60.0};

void describe(auto& v, ParticlesConfig& c) {
    v.text("name", c.name,
           "name of the group; single targets are the instances NAME_1, NAME_2 and so on",
           required);
    v.text("class", c.class_name, "class of the targets, for labels; default: NAME");
    v.number("target_strength_db", c.target_strength_db, target_strengths_db,
             "target strength of points, dB re 1 m^2");
    v.number("length_m", c.length_m, between(0, 30),
             "in place of it, the length of fish, which decides it with the sonar's frequency");
    v.number("radius_m", c.radius_m, between(0, 0.1), "likewise, the radius of bubbles of air");
    v.number("count", c.count, {0, max_particles},
             "number of targets; groups of 100 or more are one object of the labels");
    v.choice("region", c.region, particle_regions,
             "shape of the region in which the targets are at the first ping, evenly distributed");
    v.array("position_m", c.position_m, any_position_m, "middle of the region in the world",
            required);
    v.array("size_m", c.size_m, any_position_m, "size of the region along x, y and z");
    v.array("drift_m_s", c.drift_m_s, {-100, 100}, "velocity of all targets");
    v.number("rise_m_s", c.rise_m_s, between(0, 10),
             "speed at which bubbles rise, in addition; at the top of the region they start again "
             "at its bottom");
    const bool are_points = c.target_strength_db != std::array<double, 2>{};
    v.require((c.length_m[1] > 0.0) + (c.radius_m[1] > 0.0) + are_points == 1,
              {"target_strength_db", "length_m", "radius_m"},
              "targets need one of target_strength_db, length_m and radius_m, other than 0");
    v.require(are_points || c.length_m[0] > 0.0 || c.radius_m[0] > 0.0, {"length_m", "radius_m"},
              "length_m and radius_m must be above 0");
    v.require(c.kind() == ParticleKind::bubbles || c.rise_m_s == 0.0, {"rise_m_s"},
              "rise_m_s is for bubbles, which have a radius_m; others have a drift_m_s");
    v.require(c.count[1] > 0.0, {"count"}, "'count' must be above 0");
    v.require(c.count[0] == std::floor(c.count[0]) && c.count[1] == std::floor(c.count[1]),
              {"count"}, "'count' must be a whole number or two of them");
    v.require(c.size_m[0] >= 0.0 && c.size_m[1] >= 0.0 && c.size_m[2] >= 0.0, {"size_m"},
              "size_m must not be negative");
    v.require(c.rise_m_s == 0.0 || c.size_m[2] > 0.0, {"rise_m_s", "size_m"},
              "bubbles that rise need a region with a height: size_m");
}

}  // namespace sonarsim
