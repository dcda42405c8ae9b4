#include "product/annotation.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

PixelBox joined(const PixelBox& one, const PixelBox& other) {
    if (one.is_empty()) return other;
    if (other.is_empty()) return one;
    return {std::min(one.left, other.left), std::max(one.right, other.right),
            std::min(one.top, other.top), std::max(one.bottom, other.bottom)};
}

void extend(PixelBox& box, int column, int row) {
    box = joined(box, {column, column + 1, row, row + 1});
}

Annotated is_annotated(const ObjectFacts& facts, const LabelConfig& rules) {
    if (facts.is_background) return Annotated::no;
    const bool is_told_apart = facts.contrast_db || facts.shadow_contrast_db;
    const double contrast_db = std::max(std::fabs(facts.contrast_db.value_or(0.0)),
                                        std::fabs(facts.shadow_contrast_db.value_or(0.0)));
    const bool is_faint = facts.pixels < static_cast<std::uint64_t>(rules.min_pixels) ||
                          facts.visible_share.value_or(1.0) < rules.min_visible_share ||
                          (is_told_apart && contrast_db < rules.min_contrast_db);
    if (!is_faint) return Annotated::yes;
    return rules.faint == FaintObjects::crowd ? Annotated::as_crowd : Annotated::no;
}

std::optional<PixelBox> annotation_box(const PixelBox& object,
                                       const std::optional<PixelBox>& shadow, LabelBox sort) {
    if (sort == LabelBox::shadow) return shadow;
    if (sort == LabelBox::object || !shadow) return object;
    return joined(object, *shadow);
}

}  // namespace sonarsim
