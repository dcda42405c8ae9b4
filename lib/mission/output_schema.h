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
    v.flag("stages", c.stages,
           "write a fan for each stage of the echo model side by side: direct echoes, then with "
           "multipath, then with one random term after the other");
    v.number("full_scale", c.full_scale, above(0),
             "intensity that becomes white in pictures; `auto` finds it for each sonar "
             "from a few pings and writes it to dataset.json",
             or_auto);
    v.subset("labels", c.labels, label_names,
             "labels to write for every bin: `true` for all, or a list of them");
    v.flag("xtf", c.xtf, "write the waterfall of side-scan sonars as XTF as well");
    v.flag("mosaic", c.mosaic,
           "write a georeferenced mosaic of the waterfall of side-scan sonars as GeoTIFF");
}

}  // namespace sonarsim
