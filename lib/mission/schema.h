#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "mission/dataset_names.h"
#include "mission/limits.h"
#include "mission/mission.h"
#include "mission/output_schema.h"
#include "mission/scene_schema.h"
#include "mission/sonar_schema.h"
#include "mission/trajectory_keys.h"
#include "mission/variation_keys.h"

// The keys of a mission, each written once. A visitor gets every key with its value, its limits,
// its meaning and its checks. The MissionReader fills the value from YAML, the MissionWriter turns
// it into YAML, and the SchemaBuilder makes the JSON Schema, of which the tables of docs/mission.md
// are made.

namespace sonarsim {

inline constexpr std::array engine_kinds{Choice<EngineKind>{"auto", EngineKind::automatic},
                                         Choice<EngineKind>{"rays", EngineKind::rays},
                                         Choice<EngineKind>{"octree", EngineKind::octree},
                                         Choice<EngineKind>{"slices", EngineKind::slices}};

/// True if a mission may have the name. It names a folder that holds nothing but this mission.
inline bool is_folder_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.size() <= 200 &&
           name.find('/') == std::string_view::npos && name != checksums_name;
}

inline constexpr std::array water_contents{Choice<WaterContent>{"auto", WaterContent::automatic},
                                           Choice<WaterContent>{"none", WaterContent::none},
                                           Choice<WaterContent>{"clear", WaterContent::clear},
                                           Choice<WaterContent>{"coastal", WaterContent::coastal},
                                           Choice<WaterContent>{"plankton", WaterContent::plankton},
                                           Choice<WaterContent>{"plume", WaterContent::plume}};
/// All water scatters more than -200 dB, and every cloud of bubbles less than 0 dB.
inline constexpr Limits volume_strengths_db{-200.0, 0.0};

template <class Visitor>
void describe(Visitor& v, WaterLayerConfig& c) {
    v.array("depth_m", c.depth_m, between(0, 12000),
            "top and bottom of the layer, below scene.water_surface", required);
    v.require(c.depth_m[0] < c.depth_m[1], {"depth_m"},
              "'depth_m' is the top and the bottom of a layer; the first must be below the second");
    v.number("scattering_db_per_m3", c.scattering_db_per_m3, volume_strengths_db,
             "volume backscattering strength, which is added to that of the water as a power",
             required);
}

inline constexpr std::array named_profiles{
    Choice<NamedProfile>{"none", NamedProfile::none},
    Choice<NamedProfile>{"isothermal", NamedProfile::isothermal},
    Choice<NamedProfile>{"mixed_layer", NamedProfile::mixed_layer},
    Choice<NamedProfile>{"summer", NamedProfile::summer}};

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

template <class Visitor>
void describe(Visitor& v, WaterConfig& c) {
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
              "layers of the water that scatter more; they need "
              "scene.water_surface");
    v.section("profile", c.profile,
              "speed of sound by depth below scene.water_surface: sound bends, and a "
              "range is half of sound_speed_m_s times the time");
}

template <class Visitor>
void describe(Visitor& v, AccuracyConfig& c) {
    v.number("relative_l1", c.relative_l1, between(1e-4, 0.5),
             "error goal of the image without noise: the sum of its absolute errors over its sum. "
             "The sampling is derived from it");
}

template <class Visitor>
void describe(Visitor& v, OctreeConfig& c) {
    // Leaves below a millimetre are finer than any sonar's bins.
    v.number("leaf_m", c.leaf_m, between(1e-3, 1e3),
             "edge of the octree's leaves; the octree is the paper's, a baseline");
}

template <class Visitor>
void describe(Visitor& v, ClassConfig& c) {
    v.text("nodes", c.nodes,
           "names of nodes of the scene; `*` stands for any text and `?` for any one byte");
    v.text("class", c.name, "class of these nodes");
    v.text("instance", c.instance,
           "name of the one instance that these nodes form; without it each node is an instance of "
           "its own");
    v.require(!c.nodes.empty() && !c.name.empty(), {},
              "a rule for classes needs the keys 'nodes' and 'class'");
}

template <class Visitor>
void describe(Visitor& v, LabelConfig& c) {
    v.text("background", c.background,
           "background classes, which are not objects and have no contrast, shadow or visible "
           "share. `auto` stands "
           "for the classes of the nodes that scene.bottom names and for the class of the largest "
           "surface; `none` for no class");
    v.require(!c.background.empty(), {"background"},
              "'background' names classes, auto or none; with [none] all classes are objects");
}

template <class Visitor>
void describe(Visitor& v, Mission& c) {
    v.text("name", c.name, "name of the dataset; default: the name of the mission's file");
    v.require(is_folder_name(c.name), {"name"},
              "'name' names a folder: at most 200 bytes, without '/', not SHA256SUMS");
    v.number("seed", c.seed, any_unsigned, "seed of all random draws; 0 is a seed like any other");
    v.section("water", c.water, "the water");
    v.section("scene", c.scene, "what the sonars look at", required);
    v.section("trajectory", c.trajectory, "path of the vehicle; exactly one of the three forms",
              required);
    v.section("vehicle", c.vehicle,
              "offset of the vehicle from its trajectory, its movements and its navigation");
    v.require(c.water.layers.empty() || c.scene.water_surface, {"water", "scene"},
              "water.layers are depths below the water's surface: give its height by "
              "scene.water_surface");
    v.require(!c.water.profile || c.scene.water_surface, {"water", "scene"},
              "water.profile has depths below the water's surface: give its height by "
              "scene.water_surface");
    v.named("sensors", c.sensors, "one section per sonar; NAME is its folder in the dataset");
    const bool is_seen =
        !c.scene.particles.empty() || (c.scene.water_surface && c.scene.water_surface->scatters);
    v.require(!is_seen || std::ranges::all_of(c.sensors,
                                              [](const SonarConfig& s) {
                                                  return s.model == ModelKind::calibrated;
                                              }),
              {"scene", "sensors"},
              "scene.particles and scene.water_surface.scatters are for the calibrated model: the "
              "paper's has no energies that a point could add to. Give all "
              "sensors model: calibrated, or leave these keys out");
    v.require(
        !is_seen || !c.water.profile, {"scene", "water"},
        "scene.particles and scene.water_surface.scatters need straight paths of sound: leave "
        "out water.profile or these keys");
    v.section("accuracy", c.accuracy, "error goal of the images");
    v.choice(
        "engine", c.engine, engine_kinds,
        "method that finds the visible surface. `auto` takes the slices; it takes the rays "
        "for a sonar with multipath or more than 90 degrees of elevation, for side-scan sonars "
        "and cones of the calibrated model, where objects move or sound bends, and over more "
        "than half a million triangles");
    v.section("octree", c.octree, "settings of the octree");
    v.list_of("classes", c.classes, 0,
              "rules that give nodes of the scene a class, for labels; the first rule that fits a "
              "node applies");
    v.section("labels", c.labels,
              "which objects are annotated in COCO files and for YOLO, and how");
    v.section("output", c.output, "files to write, and their folder");
    v.number("variants", c.variants, between(0, 1e6),
             "number of variants of the mission, each a dataset with a seed of its own; 0 renders "
             "the mission as it stands");
    v.list_of("vary", c.vary, 0, "keys that are drawn at random");
    const auto is_of_pings = [](const VaryConfig& rule) { return rule.per == VaryPer::ping; };
    v.require(c.variants > 0 || std::ranges::all_of(c.vary, is_of_pings), {"vary", "variants"},
              "'vary' needs 'variants', the number of variants to draw, or per: ping in each of "
              "its rules");
}

}  // namespace sonarsim
