#include "compare/figures/zones.h"

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"

namespace sonarsim {

namespace {

constexpr double bottom_db = 10.0;
constexpr double stands_out_db = 15.0;
constexpr double least_power = 1e-16;
constexpr int ring_share = 28;
constexpr int smoothed_share = 44;

std::vector<double> smoothed_levels(std::span<const double> mean_powers) {
    const int count = static_cast<int>(mean_powers.size());
    const int half = count / smoothed_share / 2;
    std::vector<double> levels;
    for (int i = 0; i < count; ++i) {
        const int from = std::max(0, i - half);
        const int to = std::min(count, i + half + 1);
        double sum = 0.0;
        for (int k = from; k < to; ++k)
            sum += mean_powers[static_cast<std::size_t>(k)];
        levels.push_back(db_of_power(std::max(least_power, sum / (to - from))));
    }
    return levels;
}

}  // namespace

Zones zones_of(std::span<const double> mean_powers) {
    const std::vector<double> level = smoothed_levels(mean_powers);
    const int count = static_cast<int>(level.size());
    const auto at = [&](int i) { return level[static_cast<std::size_t>(i)]; };
    const int first = count / ring_share;
    const auto begin = level.begin() + first;
    const auto peak = std::max_element(begin, level.end());
    const double edge = *peak - bottom_db;
    const bool stands_out = *std::min_element(begin, level.end()) < *peak - stands_out_db;
    if (!stands_out) return {{}, {0, count}, {}};
    Zones zones;
    zones.bottom.from = static_cast<int>(peak - level.begin());
    zones.bottom.to = zones.bottom.from + 1;
    while (zones.bottom.from > first && at(zones.bottom.from - 1) >= edge)
        --zones.bottom.from;
    while (zones.bottom.to < count && at(zones.bottom.to) >= edge)
        ++zones.bottom.to;
    if (zones.bottom.from > first) {
        const auto end = level.begin() + zones.bottom.from;
        const double low = *std::min_element(begin, end);
        zones.water = {first, first};
        while (zones.water.to < zones.bottom.from && at(zones.water.to) <= low + (edge - low) / 3.0)
            ++zones.water.to;
    }
    if (zones.bottom.to < count) {
        const double low = *std::min_element(level.begin() + zones.bottom.to, level.end());
        int from = zones.bottom.to;
        while (from < count && at(from) > low + (edge - low) / 2.0)
            ++from;
        zones.tail = {from, count};
    }
    return zones;
}

}  // namespace sonarsim
