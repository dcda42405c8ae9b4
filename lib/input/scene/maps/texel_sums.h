#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sonarsim {

/// A box in texels: texel (row, column) fills [column, column + 1] x [row, row + 1].
struct TexelBox {
    double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;
};

/// Sums of an image's texels over boxes of any size, in constant time: a summed-area table (F. C.
/// Crow, SIGGRAPH 1984). With S(x, y), the sum of the texels left of x and above y, a box has
/// S(x1, y1) - S(x0, y1) - S(x1, y0) + S(x0, y0). Within a texel S rises bilinearly, so that
/// interpolation between whole numbers gives the exact integral over boxes that cut texels.
template <class T>
class TexelSums {
  public:
    TexelSums() = default;
    /// `value(k)` is called for every texel, row by row.
    template <class Value>
    TexelSums(int width, int height, const Value& value)
        : width_(width), height_(height), sums_(row_length() * (index(height) + 1)) {
        std::size_t texel = 0;
        for (int row = 0; row < height; ++row) {
            T left = 0;
            const std::size_t above = index(row) * row_length();
            const std::size_t here = above + row_length();
            for (int column = 0; column < width; ++column) {
                left += static_cast<T>(value(texel++));
                sums_[here + index(column) + 1] = sums_[above + index(column) + 1] + left;
            }
        }
    }

    /// The integral over a box. Beyond the image all is 0.
    double over(const TexelBox& box) const {
        const Place west = place(box.x_min, width_);
        const Place east = place(box.x_max, width_);
        const Place north = place(box.y_min, height_);
        const Place south = place(box.y_max, height_);
        return (before(east, south) - before(west, south)) -
               (before(east, north) - before(west, north));
    }

  private:
    static std::size_t index(int k) { return static_cast<std::size_t>(k); }
    std::size_t row_length() const { return index(width_) + 1; }

    /// A coordinate as the index of its texel and the fraction of the texel before it.
    struct Place {
        std::size_t texel;
        double share;
    };
    static Place place(double at, int texels) {
        at = std::clamp(at, 0.0, 1.0 * texels);
        const int texel = std::min(static_cast<int>(at), texels - 1);
        return {index(texel), at - texel};
    }

    double before(const Place& column, const Place& row) const {
        const T* const above = &sums_[row.texel * row_length() + column.texel];
        const T* const below = above + row_length();
        const double a = column.share;
        const double up = above[0] + a * (static_cast<double>(above[1]) - above[0]);
        const double down = below[0] + a * (static_cast<double>(below[1]) - below[0]);
        return up + row.share * (down - up);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> sums_;  ///< one column and one row more than the image
};

}  // namespace sonarsim
