#include "compare/figures/shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrated/decibel.h"

namespace sonarsim {

namespace {

constexpr int half_window = 2;
constexpr int least_length = 5;
constexpr double dark = 0.25;  // 6 dB below
constexpr double least_shadow_power = 1e-16;

/// The mean power of a window that ends at the image's borders.
double window_mean(const ImageView& image, int range, int column, int half_ranges) {
    double sum = 0.0, count = 0.0;
    for (int i = std::max(range - half_ranges, 0);
         i <= std::min(range + half_ranges, image.ranges - 1); ++i) {
        for (int j = std::max(column - half_window, 0);
             j <= std::min(column + half_window, image.beams - 1); ++j) {
            sum += image.at(i, j);
            count += 1.0;
        }
    }
    return sum / count;
}

/// The smoothed powers of a zone, and the median of each range.
struct Smoothed {
    std::vector<double> power;  ///< [range of the zone, column]
    std::vector<double> median;
};

Smoothed smoothed_zone(const ImageView& image, RangeZone zone) {
    Smoothed out;
    for (int i = zone.from; i < zone.to; ++i) {
        const auto first = static_cast<std::ptrdiff_t>(out.power.size());
        for (int j = 0; j < image.beams; ++j)
            out.power.push_back(window_mean(image, i, j, half_window));
        std::vector<double> row(out.power.begin() + first, out.power.end());
        const auto middle = row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2);
        std::nth_element(row.begin(), middle, row.end());
        out.median.push_back(*middle);
    }
    return out;
}

/// The range, interpolated linearly, at which the mean of 5 columns first reaches a power.
double reached_at(const ImageView& image, int column, int from, int to, double power) {
    double before = window_mean(image, from, column, 0);
    for (int i = from + 1; i < to; ++i) {
        const double here = window_mean(image, i, column, 0);
        if (here >= power) return i - (here - power) / std::max(here - before, 1e-30);
        before = here;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Depth and edge of the shadow of these ranges.
Shadow measured_shadow(const ImageView& image, RangeZone zone, const Smoothed& smoothed,
                       Shadow shadow) {
    const int trim = std::min(half_window, (shadow.to - shadow.from - 1) / 2);
    double inside = 0.0, around = 0.0;
    for (int i = shadow.from + trim; i < shadow.to - trim; ++i) {
        inside += window_mean(image, i, shadow.column, 0);
        around += smoothed.median[static_cast<std::size_t>(i - zone.from)];
    }
    const int count = shadow.to - shadow.from - 2 * trim;
    shadow.depth_db =
        db_of_power(std::max(inside, least_shadow_power) / std::max(around, least_shadow_power));
    const double low = inside / count;
    const double rise = around / count - low;
    const int middle = (shadow.from + shadow.to) / 2;
    const double quarter = reached_at(image, shadow.column, middle, zone.to, low + 0.25 * rise);
    const double most = reached_at(image, shadow.column, middle, zone.to, low + 0.75 * rise);
    shadow.edge_ranges = most - quarter;
    return shadow;
}

}  // namespace

std::vector<Shadow> shadows_of(const ImageView& image, RangeZone zone) {
    std::vector<Shadow> out;
    const Smoothed smoothed = smoothed_zone(image, zone);
    const auto is_dark = [&](int i, int j) {
        const auto row = static_cast<std::size_t>(i - zone.from);
        const auto columns = static_cast<std::size_t>(image.beams);
        return smoothed.power[row * columns + static_cast<std::size_t>(j)] <
               dark * smoothed.median[row];
    };
    for (int j = 0; j < image.beams; ++j) {
        for (int i = zone.from; i < zone.to; ++i) {
            if (!is_dark(i, j)) continue;
            Shadow shadow{j, i, i, 0.0, 0.0};
            while (shadow.to < zone.to && is_dark(shadow.to, j))
                ++shadow.to;
            i = shadow.to;
            if (shadow.to - shadow.from >= least_length)
                out.push_back(measured_shadow(image, zone, smoothed, shadow));
        }
    }
    return out;
}

}  // namespace sonarsim
