#include "compare/figures/points.h"

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"

namespace sonarsim {

namespace {

constexpr int range_reach = 4;
constexpr int beam_reach = 12;
constexpr double stands_out = 150.0;

bool is_largest(const ImageView& image, int range, int beam) {
    const float own = image.at(range, beam);
    for (int i = std::max(0, range - range_reach);
         i <= std::min(image.ranges - 1, range + range_reach); ++i) {
        for (int j = std::max(0, beam - beam_reach);
             j <= std::min(image.beams - 1, beam + beam_reach); ++j) {
            if (image.at(i, j) > own) return false;
        }
    }
    return true;
}

double median_about(const ImageView& image, int range) {
    std::vector<float> values;
    for (int i = std::max(0, range - 3); i <= std::min(image.ranges - 1, range + 3); ++i) {
        for (int j = 0; j < image.beams; ++j)
            values.push_back(image.at(i, j));
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The distance from bin `peak` in steps of `step` to where the power falls to half, by `value`.
template <class Value>
double half_width(int peak, int step, int count, const Value& value) {
    const double half = 0.5 * value(peak);
    int i = peak;
    while (i + step >= 0 && i + step < count && value(i) > half)
        i += step;
    const double above = value(i - step);
    const double share = above > value(i) ? (above - half) / (above - value(i)) : 1.0;
    return std::abs(i - peak) - 1 + std::clamp(share, 0.0, 1.0);
}

}  // namespace

std::vector<PointEcho> point_echoes(const ImageView& image, int from, int to) {
    std::vector<PointEcho> points;
    const int margin = std::min(20, image.beams / 8);
    if (image.beams < 2 * beam_reach) return points;
    for (int i = std::max(from, 1); i < std::min(to, image.ranges - 1); ++i) {
        const double least = stands_out * median_about(image, i);
        for (int j = margin; j < image.beams - margin; ++j) {
            const float own = image.at(i, j);
            if (!(own > 0.0F) || own < least || !is_largest(image, i, j)) continue;
            const auto by_beam = [&](int k) { return static_cast<double>(image.at(i, k)); };
            const auto by_range = [&](int k) { return static_cast<double>(image.at(k, j)); };
            double lobes = 0.0;
            for (const int k : {-8, -7, -6, -5, 5, 6, 7, 8})
                lobes += by_beam(std::clamp(j + k, 0, image.beams - 1)) / 8.0;
            points.push_back(
                {i, j,
                 half_width(j, -1, image.beams, by_beam) + half_width(j, 1, image.beams, by_beam),
                 half_width(i, -1, image.ranges, by_range) +
                     half_width(i, 1, image.ranges, by_range),
                 db_of_power(std::max(1e-12, lobes / own))});
        }
    }
    return points;
}

}  // namespace sonarsim
