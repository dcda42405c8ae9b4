#include "scene/seabed/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/normal_tail.h"
#include "core/units.h"
#include "scene/seabed/smooth_field.h"

namespace sonarsim {

double normal_quantile(double probability) {
    const double tail = std::min(probability, 1.0 - probability);
    if (tail <= 0.0)
        return std::copysign(std::numeric_limits<double>::infinity(), probability - 0.5);
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (normal_tail(middle) > tail ? low : high) = middle;
    }
    return std::copysign(low, probability - 0.5);
}

double length_of_patches(double patch_m) {
    // Rice: a process of unit variance crosses 0 upwards sqrt(-C''(0)) / (2 pi) times per metre,
    // and here C''(0) = -1 / (2 length^2).
    return patch_m / (2.0 * pi * std::sqrt(2.0));
}

std::vector<float> patches(const BedGrid& grid, double share, double patch_m, PhiloxKey key) {
    if (share >= 1.0 || share <= 0.0)
        return std::vector<float>(grid.size(), share > 0.0 ? 1.0F : 0.0F);
    std::vector<float> field = smooth_field(grid, length_of_patches(patch_m), key);
    const double least = normal_quantile(1.0 - share);
    // The field rises by about 2 pi within a patch's length at its border.
    constexpr double half_border = 0.05 * 2.0 * pi;
    for (float& value : field) {
        const double t = (static_cast<double>(value) - least) / (2.0 * half_border) + 0.5;
        const double s = std::clamp(t, 0.0, 1.0);
        value = static_cast<float>(s * s * (3.0 - 2.0 * s));
    }
    return field;
}

}  // namespace sonarsim
