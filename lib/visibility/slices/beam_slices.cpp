#include "visibility/slices/beam_slices.h"

#include <algorithm>
#include <cmath>

#include "visibility/slices/moved_ends.h"

namespace sonarsim {

namespace {

// Two slices that differ midway disagree, in a gap that takes up `share` of a beam, by this times
// share^(5/8) of the difference. At the slices there is none, hence a third of it. Of bins
// that other gaps light as well, a gap's difference counts by its share; of bins that it alone
// lights it counts in full: a bin is as bright for a sliver as for a wall.
constexpr float mean_of_difference = 0.33F;

// A gap is split a little beside its middle, so that no edge of a scene that is built along the
// sonar's axes runs along a slice.
constexpr float split_share = 0.4937F;

// Slices are no nearer to each other than this share of the gap of the frame that they lie in.
constexpr float least_share = 1.0F / 256.0F;

// Two ends are one where they differ by less than this share of the slice.
constexpr float same_place = 2e-4F;

/// x^(5/8) by roots, which are the same on every processor; a library's power is not.
float to_five_eighths(float x) {
    const float root = std::sqrt(x);
    return root * std::sqrt(std::sqrt(root));
}

}  // namespace

BeamSlices::BeamSlices(const View& view, std::span<const Material> materials, FrameScan& scan)
    : materials_(materials), scan_(scan), seen_(1), low_(view), high_(view) {
    scan_.see_next(seen_[0]);
}

std::uint32_t BeamSlices::see(std::uint32_t gap, double most) {
    const std::vector<Gap>& gaps = scan_.frame().gaps;
    std::uint32_t end = gap;
    while (end < gaps.size() && gaps[end].beam == gaps[gap].beam)
        ++end;
    // The slice on the border to the beam before is the first of this one.
    if (border_ != 0) std::swap(seen_[0], seen_[border_]);
    border_ = 0;
    used_ = 1;
    first_gap_ = gap;
    beam_width_ = gaps[end - 1].u_high - gaps[gap].u_low;
    around_.resize(std::max<std::size_t>(around_.size(), end - gap));
    between_.clear();
    for (std::uint32_t g = gap; g < end; ++g) {
        see_gap(g);
        split_where_wanted(g);
    }
    refine(most);
    put_in_order();
    return end;
}

void BeamSlices::see_gap(std::uint32_t gap) {
    Around& around = around_[gap - first_gap_];
    around.trapezoids.clear();
    around.with_inner = false;
    const std::uint32_t before = border_;
    border_ = new_slice();
    scan_.see_next(seen_[border_]);
    scan_.around_last_gap(around.trapezoids);
    between_.push_back({before, border_, gap});
    estimate(between_.back());
}

void BeamSlices::split_where_wanted(std::uint32_t gap) {
    for (const WantedSlice& wanted : scan_.wanted_in(gap)) {
        const Between& last = between_.back();
        if (wanted.u - seen_[last.low].slice.u < least_width(gap)) continue;
        split(between_.size() - 1, wanted.u);
    }
}

/// Splits what lies between two slices by a slice at u; the upper part becomes the last.
void BeamSlices::split(std::size_t i, float u) {
    const Between old = between_[i];
    if (!(seen_[old.low].slice.u < u && u < seen_[old.high].slice.u)) {
        between_[i].apart = 0.0F;
        return;
    }
    Around& around = around_[old.gap - first_gap_];
    if (!around.with_inner) scan_.within_gap(old.gap, around.trapezoids);
    around.with_inner = true;
    const std::uint32_t at = new_slice();
    scan_.see(u, around.trapezoids, seen_[at]);
    between_[i].high = at;
    estimate(between_[i]);
    between_.push_back({at, old.high, old.gap});
    estimate(between_.back());
}

void BeamSlices::refine(double most) {
    beams_ += 1.0;
    while (true) {
        Disagreement beam;
        std::size_t worst = between_.size();
        for (std::size_t i = 0; i < between_.size(); ++i) {
            const Between& b = between_[i];
            beam.apart += b.apart;
            beam.signal += b.signal;
            if (!(b.apart > 0.0F) || width(b) < 2.0F * least_width(b.gap)) continue;
            if (worst == between_.size() || b.apart > between_[worst].apart) worst = i;
        }
        // A dim beam may have a larger share of its signal in error than a bright one.
        const double mean = 0.5 * (beam.signal + (sum_.signal + beam.signal) / beams_);
        if (beam.apart <= most * mean || worst == between_.size()) {
            sum_.apart += beam.apart;
            sum_.signal += beam.signal;
            return;
        }
        const Between& b = between_[worst];
        split(worst, seen_[b.low].slice.u + split_share * width(b));
    }
}

/// Compares what both slices predict midway between them.
void BeamSlices::estimate(Between& between) {
    const SeenSlice& a = seen_[between.low];
    const SeenSlice& b = seen_[between.high];
    const float u = 0.5F * (a.slice.u + b.slice.u);
    const float share = width(between) / beam_width_;
    move_ends(a.slice, a.spans, u, ends_of_low_);
    move_ends(b.slice, b.spans, u, ends_of_high_);
    if (alike(a, b)) {
        between.apart = 0.0F;
        between.signal = share * last_signal_;
        return;
    }
    low_.set(scan_, materials_, a.spans, ends_of_low_);
    high_.set(scan_, materials_, b.spans, ends_of_high_);
    last_signal_ = 0.5F * (low_.sum() + high_.sum());
    between.signal = share * last_signal_;
    between.apart =
        mean_of_difference * to_five_eighths(share) * RangeProfile::difference(low_, high_);
}

/// Whether both slices show the same planes between the same ends midway.
bool BeamSlices::alike(const SeenSlice& a, const SeenSlice& b) const {
    if (a.spans.size() != b.spans.size()) return false;
    const float most = same_place * (a.slice.w_high - a.slice.w_low);
    for (std::size_t i = 0; i < a.spans.size(); ++i) {
        if (!scan_.one_plane(a.spans[i], b.spans[i])) return false;
        for (const std::size_t end : {2 * i, 2 * i + 1}) {
            if (!(std::fabs(ends_of_low_.ends[end].w - ends_of_high_.ends[end].w) <= most))
                return false;
        }
    }
    return true;
}

float BeamSlices::least_width(std::uint32_t gap) const {
    const Gap& whole = scan_.frame().gaps[gap];
    return least_share * (whole.u_high - whole.u_low);
}

float BeamSlices::width(const Between& between) const {
    return seen_[between.high].slice.u - seen_[between.low].slice.u;
}

std::uint32_t BeamSlices::new_slice() {
    if (used_ == seen_.size()) seen_.emplace_back();
    return used_++;
}

void BeamSlices::put_in_order() {
    in_order_.clear();
    for (std::uint32_t i = 0; i < used_; ++i)
        in_order_.push_back(&seen_[i]);
    std::ranges::sort(in_order_, {}, [](const SeenSlice* seen) { return seen->slice.u; });
}

}  // namespace sonarsim
