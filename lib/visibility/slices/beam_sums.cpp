#include "visibility/slices/beam_sums.h"

#include <algorithm>
#include <cmath>

#include "core/lanes.h"
#include "core/overlapped_bins.h"

namespace sonarsim {

namespace {

// Surface that ends within this distance of a bin's border touches the next bin, in bins.
constexpr float touching_bins = 0.001F;

}  // namespace

BeamDistance distance(const BeamImage& a, const BeamImage& b) {
    BeamDistance out;
    double run = 0.0;
    const int end = std::max(a.end(), b.end());
    for (int i = std::min(a.first, b.first); i < end; ++i) {
        const auto d = static_cast<double>(a.at(i) - b.at(i));
        out.absolute += std::fabs(d);
        out.squares += d * d;
        if (!(run * d > 0.0)) {
            out.runs += run * run;
            run = 0.0;
        }
        run += d;
    }
    out.runs += run * run;
    return out;
}

static_assert(BeamSums::padding >= lanes);

BeamSums::BeamSums(const View& view)
    : per_m_(static_cast<float>(1.0 / view.bin_m())),
      min_bins_(static_cast<float>(view.range_min_m / view.bin_m())),
      count_(view.range_bins),
      first_(view.range_bins),
      area_(view.range_bins + 2 + padding),
      echo_(view.range_bins + 2 + padding) {}

void BeamSums::add(const Interval& range_m, float area_m2, float height_m, float reflection) {
    const float low = range_m.from * per_m_ - min_bins_;
    const float high = std::max(range_m.to * per_m_ - min_bins_, low + least_depth_bins);
    const auto end = static_cast<float>(count_);
    if (!(high > 0.0F && low < end)) return;
    const float density = area_m2 / (high - low);
    const float intensity =
        reflection * std::min(2.0F * height_m / (range_m.from + range_m.to), 1.0F);
    const int first = static_cast<int>(std::max(low, 0.0F));
    const int last = static_cast<int>(std::min(high, end - 0.5F));
    const float to = std::min(high, end);
    for (int i = first / lanes * lanes; i <= last; i += lanes) {
        const Floats8 area = density * overlaps_of_eight(low, to, i);
        add_to(&area_[i + 1], area);
        add_to(&echo_[i + 1], intensity * area);
    }
    if (low - static_cast<float>(first) < touching_bins) touched_.push_back(first - 1);
    if (static_cast<float>(last + 1) - high < touching_bins) touched_.push_back(last + 1);
    first_ = std::min(first_, first);
    last_ = std::max(last_, last);
}

void BeamSums::add(const BeamSums& other) {
    for (int i = other.first_; i <= other.last_; ++i) {
        area_[i + 1] += other.area(i);
        echo_[i + 1] += other.echo(i);
    }
    touched_.insert(touched_.end(), other.touched_.begin(), other.touched_.end());
    first_ = std::min(first_, other.first_);
    last_ = std::max(last_, other.last_);
}

void BeamSums::append_intensities(std::vector<float>& out) const {
    if (last_ < first_) return;
    const std::size_t begin = out.size();
    out.resize(begin + static_cast<std::size_t>(last_ - first_ + 1));
    float* const __restrict to = out.data() + begin;
    for (int i = first_; i <= last_; ++i)
        to[i - first_] = intensity(i);
}

void BeamSums::clear() {
    touched_.clear();
    if (last_ >= 0) {
        std::fill(&area_[first_ + 1], &area_[last_ + 2], 0.0F);
        std::fill(&echo_[first_ + 1], &echo_[last_ + 2], 0.0F);
    }
    first_ = count_;
    last_ = -1;
}

}  // namespace sonarsim
