#include "product/annotation.h"

#include <algorithm>

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

}  // namespace sonarsim
