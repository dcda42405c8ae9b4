#pragma once

#include <array>

#include "mission/limits.h"
#include "mission/mission.h"

// The keys of what is written. As in mission/schema.h.

namespace sonarsim {

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
                                        Choice<Label>{"fan", Label::fan}};

template <class Visitor>
void describe(Visitor& v, OutputConfig& c) {
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
    v.flag("meta", c.meta, "write a JSON file per ping");
    v.flag("stages", c.stages,
           "write a fan for each stage of the echo model side by side: direct echoes, then with "
           "multipath, then with one random term after the other");
    v.number("fan_width_px", c.fan_width_px, between(0, 8192),
             "width of the fan; 0 means one pixel per range bin, at most 1024");
    v.number("full_scale", c.full_scale, above(0),
             "intensity that becomes white in pictures; `auto` finds it for each sonar "
             "from a few pings and writes it to dataset.json",
             or_auto);
    v.subset("labels", c.labels, label_names,
             "labels to write for every bin: `true` for all, or a list of them");
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

}  // namespace sonarsim
