#include "simulate/product/bottom.h"

#include <algorithm>
#include <vector>

namespace sonarsim {

std::optional<int> first_return(std::span<const float> column) {
    const int bins = static_cast<int>(column.size());
    const auto at = [&](int i) { return i < 0 || i >= bins ? 0.0F : column[i]; };
    std::vector<float> mean(column.size());
    for (int i = 0; i < bins; ++i)
        mean[i] = (at(i - 1) + at(i) + at(i + 1)) / 3.0F;
    const float half = column.empty() ? 0.0F : 0.5F * std::ranges::max(mean);
    if (!(half > 0.0F)) return std::nullopt;
    const auto first = std::ranges::find_if(mean, [&](float value) { return value >= half; });
    // The running mean rises one bin before the edge of a short echo.
    int edge = std::max(static_cast<int>(first - mean.begin()) - 1, 0);
    while (edge + 1 < bins && at(edge) < half)
        ++edge;
    return edge;
}

}  // namespace sonarsim
