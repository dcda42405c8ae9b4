#include "benchmark/summary.h"

#include <algorithm>
#include <numeric>

namespace sonarsim {

std::vector<std::size_t> sample_poses(std::size_t poses, int count) {
    const std::size_t n = std::min(poses, static_cast<std::size_t>(std::max(count, 1)));
    std::vector<std::size_t> out(n);
    for (std::size_t k = 0; k < n; ++k)
        out[k] = n > 1 ? k * (poses - 1) / (n - 1) : 0;
    return out;
}

Summary median_summary(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

Summary mean_summary(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto [min, max] = std::ranges::minmax(values);
    return {std::reduce(values.begin(), values.end()) / static_cast<double>(values.size()), min,
            max};
}

}  // namespace sonarsim
