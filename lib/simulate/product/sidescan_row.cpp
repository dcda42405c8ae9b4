#include "simulate/product/sidescan_row.h"

#include <cmath>

#include "simulate/product/bottom.h"

namespace sonarsim {

namespace {

double width_of_bin_m(const SonarConfig& config) {
    return (config.range_max_m - config.range_min_m) / config.range_bins;
}

}  // namespace

int blank_columns(const SonarConfig& config) {
    return static_cast<int>(std::lround(config.range_min_m / width_of_bin_m(config)));
}

double column_offset_m(const SonarConfig& config) {
    return config.range_min_m - blank_columns(config) * width_of_bin_m(config);
}

int waterfall_columns(const SonarConfig& config) {
    return 2 * (blank_columns(config) + config.range_bins);
}

std::vector<std::int32_t> waterfall_bins(const SonarConfig& config) {
    const int before = blank_columns(config);
    std::vector<std::int32_t> bins(waterfall_columns(config), -1);
    const int nadir = static_cast<int>(bins.size() / 2);  // the first column to starboard of it
    for (int i = 0; i < config.range_bins; ++i) {
        bins[nadir - 1 - before - i] = 2 * i + Side::port;
        bins[nadir + before + i] = 2 * i + Side::starboard;
    }
    return bins;
}

std::optional<double> first_return_m(const Sonar& sonar, const Ping& ping, int beam) {
    std::vector<float> column(ping.range_bins);
    for (int i = 0; i < ping.range_bins; ++i)
        column[i] = ping.at(i, beam);
    const std::optional<int> bin = first_return_of_swath(column);
    if (!bin) return std::nullopt;
    return sonar.middle_m(*bin);
}

}  // namespace sonarsim
