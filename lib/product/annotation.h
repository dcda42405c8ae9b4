#pragma once

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

}  // namespace sonarsim
