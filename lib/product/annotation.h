#pragma once

#include <cstdint>
#include <optional>

#include "mission/label_config.h"

namespace sonarsim {

/// A box of pixels: columns [left, right), rows [top, bottom). Empty where left = right.
struct PixelBox {
    int left = 0, right = 0, top = 0, bottom = 0;

    bool is_empty() const { return left == right; }
    bool operator==(const PixelBox&) const = default;
};

/// The smallest box around two boxes; an empty box adds nothing.
PixelBox joined(const PixelBox& one, const PixelBox& other);
/// Enlarges a box so that it holds a pixel.
void extend(PixelBox& box, int column, int row);

/// The facts of an object in a picture that the rules of annotation use.
struct ObjectFacts {
    bool is_background = false;
    std::uint64_t pixels = 0;
    std::optional<double> visible_share;       ///< empty: not known
    std::optional<double> contrast_db;         ///< empty: it has no surroundings
    std::optional<double> shadow_contrast_db;  ///< empty: no surroundings or no shadow
};

enum class Annotated { yes, as_crowd, no };

/// The way in which a picture annotates an object.
Annotated is_annotated(const ObjectFacts& facts, const LabelConfig& rules);

/// The box of an annotation; nothing if there is none of this sort.
std::optional<PixelBox> annotation_box(const PixelBox& object,
                                       const std::optional<PixelBox>& shadow, LabelBox sort);

}  // namespace sonarsim
