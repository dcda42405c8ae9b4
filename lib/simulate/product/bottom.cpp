#include "simulate/product/bottom.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// A column of range bins and its running mean over three bins.
class SmoothedColumn {
  public:
    explicit SmoothedColumn(std::span<const float> column) : column_(column), mean_(column.size()) {
        for (int i = 0; i < size(); ++i)
            mean_[i] = (at(i - 1) + at(i) + at(i + 1)) / 3.0F;
    }

    /// The value that the share `above` of the running mean exceeds; the maximum if it is 0.
    float level(double above) const {
        std::vector<float> sorted = mean_;
        const auto level = sorted.end() - 1 - static_cast<int>(above * (size() - 1));
        std::nth_element(sorted.begin(), level, sorted.end());
        return *level > 0.0F ? *level : *std::max_element(mean_.begin(), mean_.end());
    }

    float operator[](int i) const { return mean_[i]; }

    /// The first bin from `begin` on that reaches a threshold, as some running mean does.
    int edge(float threshold, int begin = 0) const {
        int i = begin;
        while (i < size() && mean_[i] < threshold)
            ++i;
        // The running mean rises one bin before the edge of a short echo.
        int edge = std::max(i - 1, 0);
        while (edge + 1 < size() && at(edge) < threshold)
            ++edge;
        return edge;
    }

  private:
    int size() const { return static_cast<int>(column_.size()); }
    float at(int i) const { return i < 0 || i >= size() ? 0.0F : column_[i]; }

    std::span<const float> column_;
    std::vector<float> mean_;
};

/// Logarithms of a column's running mean: their mean and variance over any bins.
class Logarithms {
  public:
    Logarithms(const SmoothedColumn& column, int bins, float floor)
        : sum_(bins + 1), sum2_(bins + 1) {
        std::vector<double> steps;
        for (int i = 0; i < bins; ++i) {
            const double x = logarithm(static_cast<double>(std::max(column[i], floor)));
            sum_[i + 1] = sum_[i] + x;
            sum2_[i + 1] = sum2_[i] + x * x;
            if (i >= independent)
                steps.push_back(std::fabs(x - (sum_[i - 2] - sum_[i - independent])));
        }
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
        std::nth_element(steps.begin(), middle, steps.end());
        // 0.6745 deviations are the median of |x| of a normal distribution.
        usual_ = *middle / (0.6745 * std::sqrt(2.0));
    }

    double mean(int from, int to) const { return (sum_[to] - sum_[from]) / (to - from); }

    /// The rise from the `window` bins before bin i to those from it on, in deviations of chance.
    double rise(int i, int window) const {
        const int from = std::max(i - window, 0);
        const int to = std::min(i + window, static_cast<int>(sum_.size()) - 1);
        const double before = mean(from, i);
        const double after = mean(i, to);
        const double rest =
            sum2_[to] - sum2_[from] - (i - from) * before * before - (to - i) * after * after;
        const double own = std::sqrt(std::max(rest, 0.0) / (to - from - 2));
        const double chance =
            std::max(usual_, own) * std::sqrt(independent * (1.0 / (i - from) + 1.0 / (to - i)));
        return (after - before) / std::max(chance, min_rise / min_deviations);
    }

    static constexpr double min_deviations = 5.0;
    static constexpr double min_rise = 0.6931;  // to twice the value

  private:
    static constexpr int independent = 3;  // bins of a running mean over three

    std::vector<double> sum_, sum2_;
    double usual_;
};

/// A rise of a column: its steepest bin, and the mean logarithms before it and half way up.
struct Rise {
    int at, window;
    double before, half_way;
};

std::optional<Rise> first_rise(const Logarithms& logarithms, int begin, int window, int bins) {
    const auto is_bottom = [&](int i, int bins_each) {
        return logarithms.rise(i, bins_each) >= Logarithms::min_deviations;
    };
    // The wider windows find a bottom behind a thing just above it.
    int first = begin;
    while (first < bins && !is_bottom(first, window) &&
           (first < 2 * window || !is_bottom(first, 2 * window)))
        ++first;
    if (first == bins) return std::nullopt;
    if (!is_bottom(first, window)) window *= 2;
    int steepest = first;
    for (int i = first + 1; i < std::min(first + window, bins); ++i) {
        if (logarithms.rise(i, window) > logarithms.rise(steepest, window)) steepest = i;
    }
    const double before = logarithms.mean(std::max(steepest - window, 0), steepest);
    const double after = logarithms.mean(steepest, std::min(steepest + window, bins));
    return Rise{steepest, window, before, 0.5 * (before + after)};
}

}  // namespace

std::optional<int> first_return(std::span<const float> column) {
    if (column.empty()) return std::nullopt;
    const SmoothedColumn smoothed(column);
    const float half = 0.5F * smoothed.level(0.0);
    if (!(half > 0.0F)) return std::nullopt;
    return smoothed.edge(half);
}

std::optional<int> first_return_of_swath(std::span<const float> column,
                                         std::optional<int> water_surface) {
    constexpr float min_share = 1e-3F;        // a share of the bed's level
    constexpr double surface_clutter = 1.79;  // a rise to six times the value; less may be clutter
    const int bins = static_cast<int>(column.size());
    const int window = std::max(8, bins / 64);
    if (bins < window) return std::nullopt;
    const SmoothedColumn smoothed(column);
    const float floor = min_share * smoothed.level(0.1);
    if (!(floor > 0.0F)) return std::nullopt;
    const Logarithms logarithms(smoothed, bins, floor);
    std::optional<int> in_water;  // the first edge of a thing that ends before the bottom
    for (int begin = window / 2; begin < bins;) {
        const std::optional<Rise> rise = first_rise(logarithms, begin, window, bins);
        if (!rise) break;
        const int edge = smoothed.edge(static_cast<float>(exponential(rise->half_way)),
                                       std::max(rise->at - rise->window / 2, 0));
        if (water_surface && std::abs(edge - *water_surface) <= 2 * window) {
            begin = std::max(edge, rise->at) + window;
            continue;
        }
        const bool in_clutter = water_surface && edge > *water_surface;
        if (in_clutter && 2.0 * (rise->half_way - rise->before) < surface_clutter) return {};
        const int behind = edge + 2 * window;
        if (behind + 2 * window >= bins ||
            logarithms.mean(behind, behind + 2 * window) >= rise->before + Logarithms::min_rise)
            return edge;
        in_water = in_water.value_or(edge);
        begin = behind;
    }
    return in_water;
}

}  // namespace sonarsim
