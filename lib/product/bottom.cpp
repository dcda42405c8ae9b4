#include "product/bottom.h"

#include <algorithm>
#include <vector>

namespace sonarsim {

std::optional<int> first_return(std::span<const float> column, double brighter) {
    const int n = static_cast<int>(column.size());
    if (n == 0) return std::nullopt;
    const auto at = [&](int i) { return i < 0 || i >= n ? 0.0F : column[i]; };
    std::vector<float> mean(n);
    for (int i = 0; i < n; ++i)
        mean[i] = (at(i - 1) + at(i) + at(i + 1)) / 3.0F;
    std::vector<float> sorted = mean;
    const auto level = sorted.end() - 1 - static_cast<int>(brighter * (n - 1));
    std::nth_element(sorted.begin(), level, sorted.end());
    float half = 0.5F * *level;
    if (!(half > 0.0F)) half = 0.5F * *std::max_element(mean.begin(), mean.end());
    if (!(half > 0.0F)) return std::nullopt;
    int i = 0;
    while (mean[i] < half)
        ++i;
    // The running mean rises one bin before the edge of a short echo.
    int edge = std::max(i - 1, 0);
    while (at(edge) < half)
        ++edge;
    return edge;
}

}  // namespace sonarsim
