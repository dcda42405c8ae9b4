#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine_kind.h"
#include "input/mission/dataset_names.h"
#include "input/mission/limits.h"
#include "input/mission/scene_keys.h"
#include "input/mission/sonar_keys.h"
#include "input/mission/trajectory_keys.h"
#include "input/mission/variation_keys.h"
#include "input/mission/water_keys.h"

// The keys of a mission, each written once, here and in the headers that this one includes: its
// name, which carries the unit, its default, its limits, its meaning and its checks. A visitor gets
// every key: the MissionReader fills the value from YAML, the MissionWriter turns it into YAML, and
// the ReferenceBuilder makes the tables of keys, of which the JSON Schema is made.

namespace sonarsim {

struct AccuracyConfig {
    static constexpr double min_relative_l1 = 1e-4;
    double relative_l1 = 0.03;  ///< error goal of the noise-free image
};

/// Gives a class to all nodes whose names match a pattern.
struct ClassConfig {
    std::string nodes;      ///< `*` stands for any text, `?` for any one byte
    std::string materials;  ///< in place of `nodes`: the parts of nodes of these materials
    std::string name;       ///< the class
    std::string instance;   ///< one instance of all these nodes; "": each is its own
    Location place = {};

    /// The names of the nodes, and of the parts of nodes, that the rule is for.
    std::string pattern() const { return materials.empty() ? nodes : "*." + materials; }
};

/// The bins that the mask of an object has.
enum class MaskKind { outline, echo };

/// The classes without contrast, shadow and visible share, and the masks of the others.
struct LabelConfig {
    std::vector<std::string> background{"auto"};  ///< classes that are not objects
    MaskKind mask = MaskKind::outline;            ///< the masks of `objects`
    std::vector<std::string> shadow;              ///< classes whose masks include the shadow
    Location place = {};
};

/// Labels that may be written with the image of a ping.
enum class Label {
    instance,
    share,
    second,
    class_name,
    material,
    elevation,
    height,
    shadow,
    multipath,
    clean,
    direct_only,
    multipath_only,
    objects,
    fan,
};

struct OutputConfig {
    std::filesystem::path folder;
    bool polar = true;        ///< float32 in .npy
    bool image = false;       ///< 16-bit polar PNG
    bool fan = true;          ///< 8-bit PNG
    bool stages = false;      ///< 8-bit PNG of five fans that add the model's terms one by one
    double full_scale = 0.0;  ///< intensity that becomes white; 0: automatic, by sonar
    std::vector<Label> labels = {};  ///< each at most once, in the order of the enumeration
    bool raw = true;                 ///< the instrument's output with the calibrated model

    // Products of all pings of a sonar.
    bool xtf = false;     ///< side-scan sonars: the waterfall as XTF
    bool mosaic = false;  ///< side-scan sonars: the waterfall georeferenced
    Location place = {};
};

inline constexpr auto label_names = choices_of<Label>(
    "instance", "share", "second", "class", "material", "elevation", "height", "shadow",
    "multipath", "clean", "direct_only", "multipath_only", "objects", "fan");

void describe(auto& v, OutputConfig& c) {
    v.path("folder", c.folder, "folder of the dataset; default: out/NAME in the current directory");
    v.flag("polar", c.polar,
           "write every ping of imaging and profiling sonars as float32, in .npy files");
    v.flag("image", c.image,
           "write every ping of these sonars as a 16-bit PNG, which holds no more than `polar`");
    v.flag("raw", c.raw,
           "with the calibrated model, write every ping as the instrument delivers it: a PNG for "
           "imaging and profiling sonars, a record of raw.npy for others");
    v.flag(
        "fan", c.fan,
        "write every ping of these sonars as an 8-bit fan in grey, as an operator sees it, in PNG "
        "files");
    v.flag("stages", c.stages,
           "write a fan for each stage of the echo model side by side: direct echoes, then with "
           "multipath, then with one random term after the other");
    v.number("full_scale", c.full_scale, above(0),
             "intensity that becomes white in pictures; `auto` finds it for each sonar, from the "
             "speckle of sand or from a few pings",
             or_auto);
    v.subset("labels", c.labels, label_names,
             "labels to write for every bin: `true` for all, or a list of them");
    v.flag("xtf", c.xtf, "write the waterfall of side-scan sonars as XTF as well");
    v.flag("mosaic", c.mosaic,
           "write a georeferenced mosaic of the waterfall of side-scan sonars as GeoTIFF");
}

struct Mission {
    std::string name;
    std::uint64_t seed = 0;
    WaterConfig water;
    SceneConfig scene;
    TrajectoryConfig trajectory;
    VehicleConfig vehicle;
    std::vector<SonarConfig> sensors;  ///< in the order of the file
    AccuracyConfig accuracy;
    EngineKind engine = EngineKind::automatic;
    double octree_leaf_m = 0.02;
    std::vector<ClassConfig> classes;  ///< in the order of the file; the first match applies
    LabelConfig labels;
    OutputConfig output;
    int variants = 0;              ///< number of datasets to draw; 0: the mission as it stands
    std::vector<VaryConfig> vary;  ///< rules of what is drawn, in the order of the file
    Variant variant;               ///< the variant that this mission is
};

inline constexpr auto engine_names = choices_of<EngineKind>("auto", "rays", "octree", "strips");

/// True if a mission may have the name. It names a folder that holds nothing but this mission.
inline bool is_folder_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.size() <= 200 &&
           name.find('/') == std::string_view::npos && name != checksums_name;
}

void describe(auto& v, AccuracyConfig& c) {
    v.number("relative_l1", c.relative_l1, between(AccuracyConfig::min_relative_l1, 0.5),
             "error goal of the image without noise: the sum of its absolute errors over its sum. "
             "The sampling is derived from it");
}

void describe(auto& v, ClassConfig& c) {
    v.text("nodes", c.nodes,
           "names of nodes of the scene; `*` stands for any text and `?` for any one byte");
    v.text("materials", c.materials,
           "in place of `nodes`: names of materials in the files; the part of a node of such a "
           "material is an instance of its own, NODE.MATERIAL");
    v.text("class", c.name, "class of these nodes");
    v.text("instance", c.instance,
           "name of the one instance that these nodes form; without it each node is an instance of "
           "its own");
    v.require(c.nodes.empty() != c.materials.empty() && !c.name.empty(), {},
              "a rule for classes needs the keys 'nodes' or 'materials', and 'class'");
}

inline constexpr auto mask_kinds = choices_of<MaskKind>("outline", "echo");

void describe(auto& v, LabelConfig& c) {
    v.text("background", c.background,
           "background classes, which are not objects and have no contrast, shadow or visible "
           "share. `auto` stands for the classes of the nodes that scene.bottom names and for the "
           "class of the largest surface; `none` for no class but clutter");
    v.require(!c.background.empty(), {"background"},
              "'background' names classes, auto or none; with [none] all classes are objects");
    v.choice("mask", c.mask, mask_kinds,
             "mask of an object in `objects`: `outline` is a filled outline around its visible "
             "body, as a person draws it, `echo` where its echo is the largest");
    v.text("shadow", c.shadow, "classes whose masks include the shadow behind");
    v.require(c.shadow.empty() || c.mask != MaskKind::echo, {"shadow", "mask"},
              "'shadow' needs mask: outline");
}

void describe(auto& v, Mission& c) {
    v.text("name", c.name, "name of the dataset; default: the name of the mission's file");
    v.require(is_folder_name(c.name), {"name"},
              "'name' names a folder: at most 200 bytes, without '/', not SHA256SUMS");
    v.number("seed", c.seed, any_unsigned, "seed of all random draws; 0 is a seed like any other");
    v.section("water", c.water, "the water");
    v.section("scene", c.scene, "what the sonars look at", required);
    v.section("trajectory", c.trajectory, "path of the vehicle; one of the four forms", required);
    v.section("vehicle", c.vehicle,
              "offset of the vehicle from its trajectory, its movements and its navigation");
    v.require(c.water.layers.empty() || c.scene.water_surface, {"water", "scene"},
              "water.layers are depths below the water's surface: give its height by "
              "scene.water_surface");
    v.require(!c.water.profile || c.scene.water_surface, {"water", "scene"},
              "water.profile has depths below the water's surface: give its height by "
              "scene.water_surface");
    v.named("sensors", c.sensors, "one section per sonar; NAME is its folder in the dataset");
    const bool is_visible =
        !c.scene.particles.empty() || (c.scene.water_surface && c.scene.water_surface->scatters);
    const auto is_calibrated = [](const SonarConfig& s) {
        return s.model == ModelKind::calibrated;
    };
    v.require(!is_visible || std::ranges::all_of(c.sensors, is_calibrated), {"scene", "sensors"},
              "scene.particles and scene.water_surface.scatters need model: calibrated on all "
              "sensors");
    v.require(
        !is_visible || !c.water.profile, {"scene", "water"},
        "scene.particles and scene.water_surface.scatters need straight paths of sound: leave "
        "out water.profile or these keys");
    v.require(c.water.layers.empty() || !c.water.profile, {"water"},
              "water.layers need straight paths of sound: leave out water.profile or the layers");
    v.section("accuracy", c.accuracy, "error goal of the images");
    v.choice("engine", c.engine, engine_names,
             "method that finds the visible surface; sensors.md has what `auto` takes");
    // Leaves below a millimetre are finer than any sonar's bins.
    v.number("octree_leaf_m", c.octree_leaf_m, between(1e-3, 1e3),
             "edge of the octree's leaves; the octree is the paper's, a baseline");
    v.list_of("classes", c.classes, 0,
              "rules that give nodes of the scene a class, for labels; the first rule that fits a "
              "node applies");
    v.section("labels", c.labels, "background classes and masks of objects");
    v.section("output", c.output, "files to write, and their folder");
    v.number("variants", c.variants, between(0, 1e6),
             "number of variants of the mission, each a dataset with a seed of its own; 0: none");
    v.list_of("vary", c.vary, 0, "keys that are drawn at random");
    const auto is_of_pings = [](const VaryConfig& rule) { return rule.per == VaryPer::ping; };
    v.require(c.variants > 0 || std::ranges::all_of(c.vary, is_of_pings), {"vary", "variants"},
              "'vary' needs 'variants', the number of variants to draw, or per: ping in each of "
              "its rules");
}

/// True if the water scatters sound back to some sonar.
inline bool some_water_scatters(const Mission& mission) {
    const bool is_usual = mission.water.content == WaterContent::automatic;
    return scatters(mission.water) ||
           std::ranges::any_of(mission.sensors, [&](const SonarConfig& sensor) {
               return is_usual && sensor.model == ModelKind::calibrated &&
                      sensor.instrument.usual_water != WaterContent::none;
           });
}

}  // namespace sonarsim
