#include "visibility/slices/agreeing_slices.h"

#include <algorithm>
#include <cmath>

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

AgreeingSlices::AgreeingSlices(const View& view, std::span<const Material> materials,
                               FrameScan& scan)
    : materials_(materials), scan_(scan), seen_(1), low_(view), high_(view) {
    SeenSlice& first = seen_[0];
    scan_.see_next(first);
    move_ends(first.slice, first.spans, scan_.frame().beam_u.front(), first.low);
}

bool AgreeingSlices::see_next(const DisagreementLimit& most) {
    const SliceFrame& frame = scan_.frame();
    const std::uint32_t gaps = frame.gaps();
    if (next_gap_ == gaps) return false;
    // The last slice of the gaps before is the first of these.
    if (last_ != 0) std::swap(seen_[0], seen_[last_]);
    last_ = 0;
    used_ = 1;
    first_gap_ = next_gap_;
    const auto together = static_cast<std::uint32_t>(frame.slices_per_beam);
    next_gap_ = std::min(first_gap_ + together, gaps);
    const float width = frame.slices[next_gap_].u - frame.slices[first_gap_].u;
    beam_width_ = width * static_cast<float>(together) / static_cast<float>(next_gap_ - first_gap_);
    around_.resize(together);
    between_.clear();
    for (std::uint32_t gap = first_gap_; gap < next_gap_; ++gap) {
        see_gap(gap);
        split_where_wanted(gap);
    }
    refine(most);
    collect_done();
    return true;
}

void AgreeingSlices::see_gap(std::uint32_t gap) {
    Around& around = around_[gap - first_gap_];
    around.of_slices.clear();
    around.all.clear();
    const std::uint32_t before = last_;
    last_ = new_slice();
    scan_.see_next(seen_[last_]);
    scan_.around_last_gap(around.of_slices);
    between_.push_back({before, last_, gap});
    estimate(between_.back());
}

void AgreeingSlices::split_where_wanted(std::uint32_t gap) {
    for (const WantedSlice& wanted : scan_.wanted_in(gap)) {
        const Between& last = between_.back();
        const float least = least_width(gap);
        if (wanted.u - seen_[last.low].slice.u < least) continue;
        // Midway to a slice that is one float away lies that slice itself: nothing would be left
        // for the last slice of a frame.
        if (seen_[last.high].slice.u - wanted.u < least) continue;
        split(between_.size() - 1, wanted.u);
    }
}

/// Splits what lies between two slices by a slice at u; the upper part becomes the last.
void AgreeingSlices::split(std::size_t i, float u) {
    const Between old = between_[i];
    if (!(seen_[old.low].slice.u < u && u < seen_[old.high].slice.u)) {
        between_[i].apart = 0.0F;
        return;
    }
    Around& around = around_[old.gap - first_gap_];
    if (around.all.empty()) scan_.find_candidates(old.gap, around.of_slices, around.all);
    const std::uint32_t at = new_slice();
    scan_.see(u, around.all, seen_[at]);
    between_[i].high = at;
    estimate(between_[i]);
    between_.push_back({at, old.high, old.gap});
    estimate(between_.back());
}

void AgreeingSlices::refine(const DisagreementLimit& most) {
    times_ += 1.0;
    const double lent = most.lent * std::max(most.share * sum_.signal - sum_.apart, 0.0);
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
        const double mean = 0.5 * (beam.signal + (sum_.signal + beam.signal) / times_);
        if (beam.apart <= most.share * mean + lent || worst == between_.size()) {
            sum_.apart += beam.apart;
            sum_.signal += beam.signal;
            return;
        }
        const Between& b = between_[worst];
        split(worst, seen_[b.low].slice.u + split_share * width(b));
    }
}

/// Compares what both slices predict midway, where one hands over to the other.
void AgreeingSlices::estimate(Between& between) {
    SeenSlice& a = seen_[between.low];
    SeenSlice& b = seen_[between.high];
    const float u = 0.5F * (a.slice.u + b.slice.u);
    const float share = width(between) / beam_width_;
    move_ends(a.slice, a.spans, u, a.high);
    move_ends(b.slice, b.spans, u, b.low);
    if (alike(a, b)) {
        between.apart = 0.0F;
        between.signal = share * last_signal_;
        return;
    }
    low_.set(scan_, materials_, a.spans, a.high);
    high_.set(scan_, materials_, b.spans, b.low);
    last_signal_ = 0.5F * (low_.sum() + high_.sum());
    between.signal = share * last_signal_;
    between.apart =
        mean_of_difference * to_five_eighths(share) * RangeProfile::difference(low_, high_);
}

/// Whether both slices show the same planes between the same ends midway.
bool AgreeingSlices::alike(const SeenSlice& a, const SeenSlice& b) const {
    if (a.spans.size() != b.spans.size()) return false;
    const float most = same_place * (a.slice.w_high - a.slice.w_low);
    for (std::size_t i = 0; i < a.spans.size(); ++i) {
        const VisibleSpan& x = a.spans[i];
        const VisibleSpan& y = b.spans[i];
        const float farthest = std::min(x.reach.range_m.to, y.reach.range_m.to);
        if (!scan_.one_plane(x.seen, y.seen, farthest)) return false;
        for (const std::size_t end : {2 * i, 2 * i + 1}) {
            if (!(std::fabs(a.high.ends[end].w - b.low.ends[end].w) <= most)) return false;
        }
    }
    return true;
}

float AgreeingSlices::least_width(std::uint32_t gap) const {
    const std::vector<Slice>& slices = scan_.frame().slices;
    return least_share * (slices[gap + 1].u - slices[gap].u);
}

float AgreeingSlices::width(const Between& between) const {
    return seen_[between.high].slice.u - seen_[between.low].slice.u;
}

std::uint32_t AgreeingSlices::new_slice() {
    if (used_ == seen_.size()) seen_.emplace_back();
    return used_++;
}

void AgreeingSlices::collect_done() {
    done_.clear();
    for (std::uint32_t i = 0; i < used_; ++i)
        done_.push_back(&seen_[i]);
    std::ranges::sort(done_, {}, [](const SeenSlice* seen) { return seen->slice.u; });
    if (next_gap_ < scan_.frame().gaps()) {
        done_.pop_back();
        return;
    }
    SeenSlice& last = seen_[last_];
    move_ends(last.slice, last.spans, scan_.frame().beam_u.back(), last.high);
}

}  // namespace sonarsim
