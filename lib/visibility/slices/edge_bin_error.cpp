#include "visibility/slices/edge_bin_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/overlapped_bins.h"

namespace sonarsim {

namespace {

// A bin with less surface than this share of its fuller neighbour's is often wrong: 0.3 of them
// below 0.003, 0.7 below 0.001. Counted on 92 pings of nine sonars at goals of 10, 3 and 1 %,
// compared with 60 million rays; of bins with a share of 0.003 to 0.01 less than a tenth was wrong.
constexpr float thin_share = 0.003F;
constexpr float thin_error_rate = 0.3F;
constexpr float thinnest_share = 0.001F;
constexpr float thinnest_error_rate = 0.7F;

// The same for dark bins that surface approaches to within this distance, in bins.
constexpr float touching_bins = 0.001F;
constexpr float touched_error_rate = 0.6F;

constexpr int lanes = 8;

using Lanes = std::array<float, lanes>;

double sum_of(const Lanes& x) {
    double sum = 0.0;
    for (const float lane : x)
        sum += static_cast<double>(lane);
    return sum;
}

}  // namespace

EdgeBinError::EdgeBinError(const View& view)
    : per_m_(static_cast<float>(1.0 / view.bin_m())),
      min_bins_(static_cast<float>(view.range_min_m / view.bin_m())),
      count_(view.range_bins),
      first_(view.range_bins),
      area_(view.range_bins + 2 + lanes),
      echo_(view.range_bins + 2 + lanes) {}

void EdgeBinError::begin_beam(int beam) {
    if (beam == beam_) return;
    end_beam();
    beam_ = beam;
}

void EdgeBinError::add(const Interval& range_m, float area_m2, float height_m, float reflection) {
    const float low = range_m.from * per_m_ - min_bins_;
    const float high = std::max(range_m.to * per_m_ - min_bins_, low + 1e-5F);
    const auto end = static_cast<float>(count_);
    if (!(high > 0.0F && low < end)) return;
    const float density = area_m2 / (high - low);
    const float intensity =
        reflection * std::min(2.0F * height_m / (range_m.from + range_m.to), 1.0F);
    const int first = static_cast<int>(std::max(low, 0.0F));
    const int last = static_cast<int>(std::min(high, end - 0.5F));
    const OverlappedBins bins(low, high, count_);
    for (int i = first; i <= last; ++i) {
        const float area = density * bins.overlap(i);
        area_[i + 1] += area;
        echo_[i + 1] += area * intensity;
    }
    if (low - static_cast<float>(first) < touching_bins) touched_.push_back(first - 1);
    if (static_cast<float>(last + 1) - high < touching_bins) touched_.push_back(last + 1);
    first_ = std::min(first_, first);
    last_ = std::max(last_, last);
}

/// Adds the intensities of all bins, and those of the probable errors, and clears the beam.
void EdgeBinError::end_beam() {
    Lanes all{};
    Lanes edge_bins{};
    for (int begin = first_; begin <= last_; begin += lanes) {
        for (int k = 0; k < lanes; ++k) {
            const int i = begin + k + 1;
            const float fuller = std::max(area_[i - 1], area_[i + 1]);
            const float intensity = area_[i] > 0.0F ? echo_[i] / area_[i] : 0.0F;
            const float share = area_[i] < thin_share * fuller ? thin_error_rate : 0.0F;
            all[k] += intensity;
            edge_bins[k] +=
                intensity * (area_[i] < thinnest_share * fuller ? thinnest_error_rate : share);
        }
    }
    signal_ += sum_of(all);
    error_ += sum_of(edge_bins);
    std::ranges::sort(touched_);
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const int i : touched_) {
        if (i < 0 || i >= count_ || area_[i + 1] > 0.0F) continue;
        const int fuller = area_[i] > area_[i + 2] ? i : i + 2;
        error_ += static_cast<double>(touched_error_rate * echo_[fuller] / area_[fuller]);
    }
    touched_.clear();
    if (last_ >= 0) {
        std::fill(&area_[first_ + 1], &area_[last_ + 2], 0.0F);
        std::fill(&echo_[first_ + 1], &echo_[last_ + 2], 0.0F);
    }
    first_ = count_;
    last_ = -1;
}

}  // namespace sonarsim
