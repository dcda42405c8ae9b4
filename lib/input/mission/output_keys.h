#pragma once

#include <filesystem>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of what is written, with their defaults and their descriptions as in mission.h.

namespace sonarsim {

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

inline constexpr Choice<Label> label_names[]{
    {"instance", Label::instance},       {"share", Label::share},
    {"second", Label::second},           {"class", Label::class_name},
    {"material", Label::material},       {"elevation", Label::elevation},
    {"height", Label::height},           {"shadow", Label::shadow},
    {"multipath", Label::multipath},     {"clean", Label::clean},
    {"direct_only", Label::direct_only}, {"multipath_only", Label::multipath_only},
    {"objects", Label::objects},         {"fan", Label::fan}};

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

}  // namespace sonarsim
