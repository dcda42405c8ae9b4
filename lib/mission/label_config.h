#pragma once

#include <array>
#include <string>
#include <vector>

#include "mission/limits.h"
#include "mission/place.h"

namespace sonarsim {

/// The part of a picture that the box of an annotation holds.
enum class LabelBox { object, shadow, both };

/// The treatment of objects of which too little is seen.
enum class FaintObjects { omit, crowd };

inline constexpr std::array faint_objects{Choice<FaintObjects>{"omit", FaintObjects::omit},
                                          Choice<FaintObjects>{"crowd", FaintObjects::crowd}};
inline constexpr std::array label_boxes{Choice<LabelBox>{"object", LabelBox::object},
                                        Choice<LabelBox>{"shadow", LabelBox::shadow},
                                        Choice<LabelBox>{"both", LabelBox::both}};

/// The rules of annotations: of COCO files and of YOLO's. Label images follow none of them.
struct LabelConfig {
    std::vector<std::string> background{"auto"};  ///< classes that get no annotation
    int min_pixels = 16;                          ///< a square of four pixels a side
    double min_visible_share = 0.1;               ///< share of its solid angle
    double min_contrast_db = 1.0;                 ///< contrast of object or shadow, either way
    FaintObjects faint = FaintObjects::omit;
    LabelBox box = LabelBox::object;
    MissionPlace place;

    bool operator==(const LabelConfig&) const = default;
};

}  // namespace sonarsim
