#include "simulate/product/bottom.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sonarsim {

namespace {

/// A column of range bins and its running mean over three bins.
class SmoothedColumn {
  public:
    explicit SmoothedColumn(std::span<const float> column) : column_(column), mean_(column.size()) {
        for (int i = 0; i < size(); ++i)
            mean_[i] = (at(i - 1) + at(i) + at(i + 1)) / 3.0F;
    }

    /// The level that the share `brighter` of the running mean exceeds; the maximum if it is 0.
    float level(double brighter) const {
        std::vector<float> sorted = mean_;
        const auto level = sorted.end() - 1 - static_cast<int>(brighter * (size() - 1));
        std::nth_element(sorted.begin(), level, sorted.end());
        return *level > 0.0F ? *level : max_level(size());
    }

    /// The greatest running mean of the first bins.
    float max_level(int bins) const {
        return bins > 0 ? *std::max_element(mean_.begin(), mean_.begin() + bins) : 0.0F;
    }

    /// The first bin that reaches a threshold, which some running mean reaches.
    int edge(float threshold) const {
        int i = 0;
        while (mean_[i] < threshold)
            ++i;
        // The running mean rises one bin before the edge of a short echo.
        int edge = std::max(i - 1, 0);
        while (at(edge) < threshold)
            ++edge;
        return edge;
    }

  private:
    int size() const { return static_cast<int>(column_.size()); }
    float at(int i) const { return i < 0 || i >= size() ? 0.0F : column_[i]; }

    std::span<const float> column_;
    std::vector<float> mean_;
};

}  // namespace

std::optional<int> first_return(std::span<const float> column, double brighter) {
    if (column.empty()) return std::nullopt;
    const SmoothedColumn smoothed(column);
    const float half = 0.5F * smoothed.level(brighter);
    if (!(half > 0.0F)) return std::nullopt;
    return smoothed.edge(half);
}

std::optional<int> first_return_of_swath(std::span<const float> column) {
    constexpr double brighter = 0.1;
    constexpr float faintest = 1e-3F;  // 30 dB below the level of the bottom
    constexpr float clear = 0.1F;      // a lower threshold than half pays only far above the water
    const std::optional<int> half_way = first_return(column, brighter);
    if (!half_way) return std::nullopt;
    const SmoothedColumn smoothed(column);
    const float bottom = smoothed.level(brighter);
    const float water = smoothed.max_level(2 * *half_way / 3);
    const float between = std::max(std::sqrt(water * bottom), faintest * bottom);
    return between < clear * bottom ? smoothed.edge(between) : *half_way;
}

}  // namespace sonarsim
