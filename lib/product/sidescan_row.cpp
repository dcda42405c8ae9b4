#include "product/sidescan_row.h"

#include "product/bottom.h"

namespace sonarsim {

namespace {

constexpr int starboard = 0;  // the beams of a side-scan ping
constexpr int port = 1;

/// Strong targets on a tenth of a side leave the level of its bottom alone.
constexpr double brighter_share = 0.1;

std::optional<double> first_return_m(const Sonar& sonar, const Ping& ping, int beam) {
    std::vector<float> column(ping.range_bins);
    for (int i = 0; i < ping.range_bins; ++i)
        column[i] = ping.at(i, beam);
    const std::optional<int> bin = first_return(column, brighter_share);
    if (!bin) return std::nullopt;
    return 0.5 * (sonar.range_edges_m[*bin] + sonar.range_edges_m[*bin + 1]);
}

}  // namespace

std::vector<float> sidescan_row(const Ping& ping) {
    const int n = ping.range_bins;
    std::vector<float> row(2 * static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        row[n - 1 - i] = ping.at(i, port);
        row[n + i] = ping.at(i, starboard);
    }
    return row;
}

FirstReturns first_returns(const Sonar& sonar, const Ping& ping) {
    return {first_return_m(sonar, ping, port), first_return_m(sonar, ping, starboard)};
}

}  // namespace sonarsim
