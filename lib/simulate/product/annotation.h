#pragma once

#include <algorithm>

namespace sonarsim {

/// A box of pixels: columns [left, right), rows [top, bottom). Empty where left = right.
struct PixelBox {
    int left = 0, right = 0, top = 0, bottom = 0;

    bool is_empty() const { return left == right; }
    bool operator==(const PixelBox&) const = default;
};

/// The smallest box around two boxes; an empty box adds nothing.
inline PixelBox joined(const PixelBox& one, const PixelBox& other) {
    if (one.is_empty()) return other;
    if (other.is_empty()) return one;
    return {std::min(one.left, other.left), std::max(one.right, other.right),
            std::min(one.top, other.top), std::max(one.bottom, other.bottom)};
}

}  // namespace sonarsim
