#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "core/input_limits.h"
#include "mission/dataset_names.h"
#include "mission/instrument_schema.h"
#include "mission/limits.h"
#include "mission/mission.h"
#include "mission/scene_schema.h"
#include "mission/sonar_keys.h"
#include "mission/trajectory_schema.h"
#include "mission/variation_schema.h"

// The keys of a mission, each written once. A visitor is handed every key with its value, its
// limits, its meaning and its checks; the MissionReader fills the value from YAML, the
// MissionWriter turns it into YAML, the KeyCollector (reference.cpp) makes the tables of
// docs/mission.md.

namespace sonarsim {

inline constexpr std::array multipath_methods{
    Choice<MultipathMethod>{"none", MultipathMethod::none},
    Choice<MultipathMethod>{"cluster", MultipathMethod::cluster},
    Choice<MultipathMethod>{"exact", MultipathMethod::exact}};
inline constexpr std::array engine_kinds{Choice<EngineKind>{"auto", EngineKind::automatic},
                                         Choice<EngineKind>{"rays", EngineKind::rays},
                                         Choice<EngineKind>{"octree", EngineKind::octree},
                                         Choice<EngineKind>{"slices", EngineKind::slices}};

inline constexpr std::array label_names{Choice<Label>{"instance", Label::instance},
                                        Choice<Label>{"share", Label::share},
                                        Choice<Label>{"second", Label::second},
                                        Choice<Label>{"class", Label::class_name},
                                        Choice<Label>{"material", Label::material},
                                        Choice<Label>{"elevation", Label::elevation},
                                        Choice<Label>{"height", Label::height},
                                        Choice<Label>{"shadow", Label::shadow},
                                        Choice<Label>{"multipath", Label::multipath},
                                        Choice<Label>{"clean", Label::clean},
                                        Choice<Label>{"direct_only", Label::direct_only},
                                        Choice<Label>{"multipath_only", Label::multipath_only},
                                        Choice<Label>{"objects", Label::objects},
                                        Choice<Label>{"fan", Label::fan},
                                        Choice<Label>{"semantic", Label::semantic},
                                        Choice<Label>{"coco", Label::coco},
                                        Choice<Label>{"yolo", Label::yolo},
                                        Choice<Label>{"yolo_polygons", Label::yolo_polygons}};

inline constexpr std::array fan_colours{
    Choice<FanColours>{"grey", FanColours::grey}, Choice<FanColours>{"copper", FanColours::copper},
    Choice<FanColours>{"amber", FanColours::amber}, Choice<FanColours>{"sea", FanColours::sea}};

inline constexpr std::array packs{Choice<Pack>{"none", Pack::none}, Choice<Pack>{"tar", Pack::tar}};

/// Fit for the name of a folder that holds nothing but one mission.
inline bool is_folder_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.size() <= 200 &&
           name.find('/') == std::string_view::npos && !is_taken_by_collection(name);
}

template <class Visitor>
void describe(Visitor& v, WaterConfig& c) {
    v.number("density_kg_m3", c.density_kg_m3, between(least_medium, largest_medium),
             "density of the water");
    v.number_or_auto("sound_speed_m_s", c.sound_speed_m_s, between(least_medium, largest_medium),
                     "speed of sound in the water; `auto` computes it from temperature, salinity "
                     "and depth by Mackenzie's formula");
    v.number(
        "temperature_c", c.temperature_c, between(-2, 40),
        "temperature, for the absorption of the calibrated model and for sound_speed_m_s: auto");
    v.number("salinity_psu", c.salinity_psu, between(0, 45), "salinity, for the same");
    v.number("depth_m", c.depth_m, between(0, 12000), "depth below the surface, for the same");
    v.number("ph", c.ph, between(6, 9), "acidity, for the absorption of the calibrated model");
}

template <class Visitor>
void describe(Visitor& v, MountConfig& c) {
    v.numbers("translation_m", c.translation_m, any_position_m,
              "position of the sonar in the vehicle's frame");
    v.numbers("rpy_deg", c.rpy_deg, any_angle_deg,
              "roll, pitch and yaw on top of the default mount");
}

template <class Visitor>
void describe(Visitor& v, MultipathConfig& c) {
    v.choice("method", c.method, multipath_methods,
             "multipath via a second surface: `cluster` traces one ray for a cluster of samples, "
             "`exact` one for every sample");
    v.integer("epsilon_bins", c.epsilon_bins, between(0, 8192),
              "size of a cluster in range, azimuth and elevation bins");
    v.number("delta_deg", c.delta_deg, between(0, 180),
             "largest angle between the normals within a cluster");
}

template <class Visitor>
void describe(Visitor& v, SonarConfig& c) {
    const SonarKeys& keys = v.sonar_kind("kind", c, "the kind of sonar");
    v.path("preset", c.preset,
           "YAML file with keys of this section, such as those of configs/sensors; keys given here "
           "override those of the file");
    v.section("mount", c.mount, "where the sonar sits on the vehicle");
    v.integer("every", c.every, at_least(1), "the sonar pings at every n-th pose");
    if (keys.opening)
        v.number("opening_deg", c.opening_deg, between(1e-3, 180), "full angle of the cone");
    if (keys.azimuth)
        v.number("azimuth_deg", c.azimuth_deg, between(1e-3, 360), "full angle in azimuth");
    if (keys.elevation)
        v.number("elevation_deg", c.elevation_deg, between(1e-3, 180), "full angle in elevation");
    if (keys.head) {
        v.number(
            "sector_deg", c.sector_deg, between(1e-2, 360),
            "full angle that the head covers; at 360 it keeps turning, below it sweeps to and fro");
        v.number(
            "step_deg", c.step_deg, between(1e-2, 360),
            "angle that the head turns from ping to ping, rounded so that it divides the sector");
        v.require(c.step_deg <= c.sector_deg, {"sector_deg", "step_deg"},
                  "step_deg must be at most sector_deg");
    }
    v.number("range_min_m", c.range_min_m, at_least(0), "nearest slant range, one way");
    v.number("range_max_m", c.range_max_m, above(0), "farthest slant range, one way");
    // 8192 x 8192 bins are 2^26, the largest image that is rendered.
    v.integer("range_bins", c.range_bins, between(1, 8192),
              "number of range bins of a ping; for a side-scan sonar, of each side");
    if (keys.azimuth_bins)
        v.integer("azimuth_bins", c.azimuth_bins, between(1, 8192), "number of beams of a ping");
    v.section("multipath", c.multipath, "multipath via a second surface");
    v.choice(
        "model", c.model, echo_models,
        "echo model: the paper's, or the calibrated one, which gives what the instrument measures");
    if (c.model == ModelKind::calibrated) {
        v.section("instrument", c.instrument, "the instrument of the calibrated model");
        const BeamConfig& beam = c.instrument.beam;
        const bool forward = beam.aperture == Aperture::line || beam.aperture == Aperture::head;
        v.require(!forward || c.azimuth_deg < 180.0, {"azimuth_deg", "model"},
                  "the line array of the calibrated model looks forward: azimuth_deg must be below "
                  "180");
        v.require(beam.view_azimuth_deg == 0.0 || beam.view_azimuth_deg >= c.azimuth_deg,
                  {"azimuth_deg", "instrument"},
                  "instrument.beam.view_azimuth_deg must be 0 or at least azimuth_deg");
        v.require(beam.aperture != Aperture::head || c.azimuth_deg >= beam.width_deg,
                  {"azimuth_deg", "instrument"},
                  "azimuth_deg limits what a calibrated scanning sonar insonifies: it must be at "
                  "least instrument.beam.width_deg; 2.5 times the width holds the main lobe, 4 "
                  "times the first side lobes");
        v.require(beam.aperture != Aperture::port_starboard || c.elevation_deg >= beam.width_deg,
                  {"elevation_deg", "instrument"},
                  "elevation_deg limits what a calibrated side-scan sonar insonifies: it must be "
                  "at least instrument.beam.width_deg; a few times the width holds the side lobes");
        v.require(beam.aperture != Aperture::piston || c.opening_deg >= beam.width_deg,
                  {"opening_deg", "instrument"},
                  "opening_deg limits what a calibrated echosounder insonifies: it must be at "
                  "least instrument.beam.width_deg; 3 times the width holds the main lobe");
    }
    if (c.model == ModelKind::paper) {
        v.section("noise", c.noise, "the random terms of the paper's model");
        v.section("streaks", c.streaks, "azimuth streaks of the paper's model");
    }
    v.require(keys.range_noise || c.noise.range_lambda_m == 0.0, {"noise"},
              "a side-scan sonar has no range noise: range_lambda_m must be 0");
    v.require(c.range_min_m < c.range_max_m, {"range_min_m", "range_max_m"},
              "range_min_m must be below range_max_m");
    v.require((c.range_max_m - c.range_min_m) / c.range_bins > 1e-6,
              {"range_min_m", "range_max_m", "range_bins"},
              "range bins must be wider than a micrometre");
    v.require(
        c.kind != SonarKind::sidescan ||
            c.range_min_m <= 65536.0 * (c.range_max_m - c.range_min_m) / c.range_bins,
        {"range_min_m", "range_max_m", "range_bins"},
        "a side-scan's waterfall begins at nadir: range_min_m must be at most 65536 range bins");
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
    v.number_or_auto("leaf_m", c.leaf_m, between(1e-3, 1e3),
                     "edge of the octree's leaves; `auto` derives it from accuracy.relative_l1");
    v.integer(
        "memory_mb", c.memory_mb, between(1, 1e6),
        "memory limit; above it the octree drops the nodes that have not been seen for longest");
    v.flag("literal", c.literal, "use the octree exactly as the paper prints it, as a baseline");
}

template <class Visitor>
void describe(Visitor& v, SlicesConfig& c) {
    v.integer(
        "per_beam", c.per_beam, between(0, 64),
        "slices per beam, one of them on its border; 0 derives the number from "
        "accuracy.relative_l1. Wide beams, the sides of a side-scan sonar and cones have more");
}

template <class Visitor>
void describe(Visitor& v, ClassConfig& c) {
    v.place(c.place);
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
void describe(Visitor& v, SplitConfig& c) {
    v.place(c.place);
    v.number("train", c.train, between(0, 1), "share of the trajectory for training");
    v.number("val", c.val, between(0, 1), "share for validation");
    v.number("test", c.test, between(0, 1), "share for testing");
    const double sum = c.train + c.val + c.test;
    v.require(!c.is_on() || (sum > 1.0 - 1e-6 && sum < 1.0 + 1e-6), {"train", "val", "test"},
              "train, val and test must add up to 1");
    v.integer("gap", c.gap, between(0, 1e6),
              "poses at each border of two parts that belong to neither of them");
    v.integer("rounds", c.rounds, between(1, 1e6),
              "number of times that train, val and test repeat along the trajectory");
}

template <class Visitor>
void describe(Visitor& v, FanStyleConfig& c) {
    v.choice("colours", c.colours, fan_colours,
             "colour map from dark to bright; `sea` goes from violet over green to yellow");
    v.flag("rings", c.rings, "draw rings of equal range, with their numbers");
    v.flag("bearings", c.bearings,
           "draw lines of equal azimuth, with their degrees to port (P) and starboard (S)");
}

template <class Visitor>
void describe(Visitor& v, OutputConfig& c) {
    v.path("folder", c.folder, "folder of the dataset; default: out/NAME in the current directory");
    v.flag("polar", c.polar, "write every ping of imaging and profiling sonars as float32");
    v.flag("image", c.image,
           "write every ping of these sonars as a 16-bit PNG, which holds no more than `polar`");
    v.flag("raw", c.raw,
           "with the calibrated model, write every ping as the instrument delivers it: a PNG for "
           "imaging and profiling sonars, a record of raw.npy for others");
    v.flag("fan", c.fan,
           "write every ping of these sonars as an 8-bit fan, as an operator sees it");
    v.flag("meta", c.meta, "write a JSON file per ping");
    v.flag("stages", c.stages,
           "write a fan for each stage of the echo model side by side: direct echoes, then with "
           "multipath, then with one random term after the other");
    v.integer("fan_width_px", c.fan_width_px, between(0, 8192),
              "width of the fan; 0 means one pixel per range bin, at most 1024");
    v.section("fan_style", c.fan_style,
              "style of the fans and scans in PNG files: one grey channel by default, RGB if any "
              "key is set");
    v.number_or_auto("full_scale", c.full_scale, above(0),
                     "intensity that becomes white in pictures; `auto` finds it for each sonar "
                     "from a few pings and writes it to dataset.json");
    v.subset("labels", c.labels, label_names,
             "labels to write for every bin: `true` for all, or a list of them");
    v.place("labels", c.labels_place);
    v.section(
        "split", c.split,
        "lists of poses for training, validation and testing, by stretches of the trajectory");
    v.choice("pack", c.pack, packs,
             "`tar` writes the files of pings into a few archives that WebDataset reads; `none` "
             "writes single files");
    v.number("pack_size_mb", c.pack_size_mb, between(1e-3, 1e6),
             "largest size of an archive; it holds as many pings as surely fit");
    v.flag("waterfall", c.waterfall, "write the waterfalls of side-scan sonars");
    v.flag("echogram", c.echogram, "write the echograms of echosounders");
    v.flag("soundings", c.soundings,
           "write the soundings of profiling sonars and the map made of them");
    v.flag("scan", c.scan, "write the scans of scanning sonars");
    v.number("bathymetry_cell_m", c.bathymetry_cell_m, at_least(0),
             "cell size of the map of soundings; 0 gives a cell four soundings or more on average");
    v.flag("xtf", c.xtf, "with `waterfall`, write it as XTF as well, for other programs");
    v.flag("mosaic", c.mosaic, "with `waterfall`, write a georeferenced mosaic of it as GeoTIFF");
    v.number("mosaic_cell_m", c.mosaic_cell_m, at_least(0),
             "cell size of the mosaic; 0 means the distance between pings");
    v.require(c.waterfall || !(c.xtf || c.mosaic), {"waterfall", "xtf", "mosaic"},
              "xtf and mosaic are made of the waterfall: write waterfall: true");
}

template <class Visitor>
void describe(Visitor& v, Mission& c) {
    v.text("name", c.name, "name of the dataset; default: the name of the mission's file");
    v.require(is_folder_name(c.name), {"name"},
              "'name' names a folder: at most 200 bytes, without '/', not SHA256SUMS or "
              "collection.json");
    v.integer("seed", c.seed, "seed of all random draws; 0 is a seed like any other");
    v.section("water", c.water, "the water");
    v.section("scene", c.scene, "what the sonars look at", required);
    v.section("trajectory", c.trajectory, "where the vehicle goes; exactly one of the three forms",
              required);
    v.section("vehicle", c.vehicle, "offset of the vehicle from its trajectory");
    v.named("sensors", c.sensors, "one section per sonar; NAME is its folder in the dataset");
    v.section("accuracy", c.accuracy, "error goal of the images");
    v.choice("engine", c.engine, engine_kinds,
             "method that finds the visible surface. `auto` takes the slices; it takes the rays "
             "for a sonar with multipath, where they meet the error goal with less work, and where "
             "objects move. The octree sees up to 160 degrees of elevation or opening");
    v.section("octree", c.octree, "settings of the octree");
    v.section("slices", c.slices, "settings of the slices");
    v.list("classes", c.classes, 0,
           "rules that give nodes of the scene a class, for labels; the first rule that fits a "
           "node applies");
    v.section("output", c.output, "what is written, and where");
    v.integer("variants", c.variants, between(0, 1e6),
              "number of variants of the mission, each a dataset with a seed of its own; 0 renders "
              "the mission as it stands");
    v.list("vary", c.vary, 0, "keys that are drawn at random");
    const auto is_of_pings = [](const VaryConfig& rule) { return rule.per == VaryPer::ping; };
    v.require(c.variants > 0 || std::ranges::all_of(c.vary, is_of_pings), {"vary", "variants"},
              "'vary' needs 'variants', the number of variants to draw, or per: ping in each of "
              "its rules");
}

}  // namespace sonarsim
