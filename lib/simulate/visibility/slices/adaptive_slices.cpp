#include "simulate/visibility/slices/adaptive_slices.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// The expected error in a gap is this times share^(5/8) of the difference midway between its two
// slices, where the gap covers `share` of a beam. The error is zero at the slices, hence a third.
constexpr float mean_of_difference = 0.33F;

// The share of the allowance left by earlier beams that a beam may use.
constexpr double carry_over_share = 0.25;

// A gap is split slightly off its middle, so that slices do not run along edges that are parallel
// to the sonar's axes.
constexpr float split_share = 0.4937F;

// Least distance of two slices, as a share of the frame's gap between them.
constexpr float min_share = 1.0F / 256.0F;

// Two ends are equal if they differ by less than this share of the slice.
constexpr float same_place = 2e-4F;

// A piece that no slice meets belongs to the predicted surface if it is nearer by this at most, in
// bins.
constexpr float same_range = 0.3F;

/// x^(5/8) by square roots, which are the same on every processor; a library's power function is
/// not.
float to_five_eighths(float x) {
    const float root = std::sqrt(x);
    return root * std::sqrt(std::sqrt(root));
}

}  // namespace

float strip_border(const SliceResult& low, const SliceResult& high) {
    const float middle = 0.5F * (low.slice.u + high.slice.u);
    if (low.spans.empty() && high.spans.empty()) return middle;
    float end = low.slice.u;
    for (const VisibleSpan& span : low.spans)
        end = std::max(end, span.facet_extent.u.to);
    float begin = high.slice.u;
    for (const VisibleSpan& span : high.spans)
        begin = std::min(begin, span.facet_extent.u.from);
    float border = middle;
    if (end < middle) border = std::max(end, std::min(begin, middle));
    if (begin > middle) border = std::min(begin, std::max(end, middle));
    return low.slice.u < border && border < high.slice.u ? border : middle;
}

AdaptiveSlices::AdaptiveSlices(const View& view, std::span<const Material> materials,
                               FrameScan& scan)
    : materials_(materials),
      scan_(scan),
      results_(1),
      low_(view),
      high_(view),
      unseen_(view),
      same_range_m_(same_range * static_cast<float>(view.bin_m())) {
    SliceResult& first = results_[0];
    scan_.scan_next(first);
    move_ends(first.slice, first.spans, scan_.frame().beam_u.front(), first.low);
}

bool AdaptiveSlices::scan_next(double max_share) {
    const SliceFrame& frame = scan_.frame();
    const std::uint32_t gaps = frame.gaps();
    if (next_gap_ == gaps) return false;
    // The last slice of the gaps before is the first of these.
    if (last_ != 0) std::swap(results_[0], results_[last_]);
    last_ = 0;
    used_ = 1;
    first_gap_ = next_gap_;
    const auto together = static_cast<std::uint32_t>(frame.slices_per_beam);
    next_gap_ = std::min(first_gap_ + together, gaps);
    const float width = frame.slices[next_gap_].u - frame.slices[first_gap_].u;
    beam_width_ = width * static_cast<float>(together) / static_cast<float>(next_gap_ - first_gap_);
    around_.resize(together);
    subgaps_.clear();
    for (std::uint32_t gap = first_gap_; gap < next_gap_; ++gap) {
        scan_gap(gap);
        split_where_requested(gap);
    }
    refine(max_share);
    collect_done();
    return true;
}

void AdaptiveSlices::scan_gap(std::uint32_t gap) {
    AroundGap& around = around_[gap - first_gap_];
    around.of_slices.clear();
    around.all.clear();
    around.unseen.clear();
    const std::uint32_t before = last_;
    last_ = new_slice();
    scan_.scan_next(results_[last_]);
    scan_.around_last_gap(around.of_slices);
    scan_.find_unseen(gap, around.unseen);
    subgaps_.push_back({before, last_, gap});
    estimate(subgaps_.back());
}

void AdaptiveSlices::split_where_requested(std::uint32_t gap) {
    for (const RequestedSlice& requested : scan_.requested_in(gap)) {
        const Subgap& last = subgaps_.back();
        const float least = min_width(gap);
        if (requested.u - results_[last.low].slice.u < least) continue;
        // If the next slice is one float away, the midpoint is that slice itself: no width would be
        // left for the last slice of a frame.
        if (results_[last.high].slice.u - requested.u < least) continue;
        split(subgaps_.size() - 1, requested.u);
    }
}

/// Splits the interval between two slices at u; its upper part is appended.
void AdaptiveSlices::split(std::size_t i, float u) {
    const Subgap old = subgaps_[i];
    if (!(results_[old.low].slice.u < u && u < results_[old.high].slice.u)) {
        subgaps_[i].difference = 0.0F;
        return;
    }
    const std::uint32_t at = new_slice();
    scan_.scan_slice(u, candidates(old.gap), results_[at]);
    subgaps_[i].high = at;
    estimate(subgaps_[i]);
    subgaps_.push_back({at, old.high, old.gap});
    estimate(subgaps_.back());
}

const std::vector<std::uint32_t>& AdaptiveSlices::candidates(std::uint32_t gap) {
    AroundGap& around = around_[gap - first_gap_];
    if (around.all.empty()) scan_.find_candidates(gap, around.of_slices, around.all);
    return around.all;
}

void AdaptiveSlices::refine(double max_share) {
    times_ += 1.0;
    const double carry_over =
        carry_over_share * std::max(max_share * sum_.signal - sum_.difference, 0.0);
    while (true) {
        SliceError beam;
        std::size_t worst = subgaps_.size();
        for (std::size_t i = 0; i < subgaps_.size(); ++i) {
            const Subgap& b = subgaps_[i];
            beam.difference += b.difference;
            beam.signal += b.signal;
            if (!(b.difference > 0.0F) || width(b) < 2.0F * min_width(b.gap)) continue;
            if (worst == subgaps_.size() || b.difference > subgaps_[worst].difference) worst = i;
        }
        // The mean lets a dim beam have a larger relative error than a bright one.
        const double mean = 0.5 * (beam.signal + (sum_.signal + beam.signal) / times_);
        if (beam.difference <= max_share * mean + carry_over || worst == subgaps_.size()) {
            sum_.difference += beam.difference;
            sum_.signal += beam.signal;
            return;
        }
        split(worst, subgaps_[worst].split_u);
    }
}

/// Compares the predictions of both slices at the border of their strips.
void AdaptiveSlices::estimate(Subgap& subgap) {
    SliceResult& a = results_[subgap.low];
    SliceResult& b = results_[subgap.high];
    const float u = strip_border(a, b);
    const float share = width(subgap) / beam_width_;
    move_ends(a.slice, a.spans, u, a.high);
    move_ends(b.slice, b.spans, u, b.low);
    subgap.split_u = a.slice.u + split_share * width(subgap);
    find_outstanding(subgap);
    if (outstanding_.empty() && alike(a, b)) {
        subgap.difference = 0.0F;
        subgap.signal = share * last_signal_;
        return;
    }
    low_.set(scan_, materials_, a.spans, a.high);
    high_.set(scan_, materials_, b.spans, b.low);
    last_signal_ = 0.5F * (low_.sum() + high_.sum());
    subgap.signal = share * last_signal_;
    subgap.difference =
        mean_of_difference * to_five_eighths(share) * RangeProfile::difference(low_, high_);
    if (!outstanding_.empty()) add_unseen(subgap);
}

/// Adds the change of the image by the pieces that stand out, which is certain, to the difference
/// of the two predictions. The next slice passes through the largest of these pieces.
void AdaptiveSlices::add_unseen(Subgap& subgap) {
    unseen_.set(outstanding_, beam_width_);
    subgap.difference += RangeProfile::change(low_, high_, unseen_);
    const float u = (*std::ranges::max_element(outstanding_, {}, &UnseenPiece::area_m2))->u;
    const float least = min_width(subgap.gap);
    if (u - results_[subgap.low].slice.u > least && results_[subgap.high].slice.u - u > least)
        subgap.split_u = u;
}

/// Finds the pieces between two slices that stand out from the surface that the nearer slice
/// predicts.
void AdaptiveSlices::find_outstanding(const Subgap& subgap) {
    outstanding_.clear();
    const SliceResult& a = results_[subgap.low];
    const SliceResult& b = results_[subgap.high];
    for (const UnseenPiece& piece : around_[subgap.gap - first_gap_].unseen) {
        if (!(a.slice.u < piece.facet_u.from && piece.facet_u.to < b.slice.u)) continue;
        if (piece.u < a.high.u ? is_nearer_than_predicted(piece, a, a.high)
                               : is_nearer_than_predicted(piece, b, b.low))
            outstanding_.push_back(&piece);
    }
}

/// True if the piece is nearer than the surface that a slice predicts there by more than
/// `same_range`, or if the slice predicts none. `ends` are those of the slice, moved to one side.
bool AdaptiveSlices::is_nearer_than_predicted(const UnseenPiece& piece, const SliceResult& near,
                                              const MovedEnds& ends) const {
    const float share = (piece.u - near.slice.u) / (ends.u - near.slice.u);
    const auto place = [&](const MovedEnd& end) -> float {
        return end.at_slice + share * (end.w - end.at_slice);
    };
    // Ends are in order, so the first span that ends above the piece holds it, or no span does.
    const VisibleSpan* const first = near.spans.data();
    const auto span = std::ranges::partition_point(near.spans, [&](const VisibleSpan& at) {
        return place(ends.ends[2 * (&at - first) + 1]) < piece.w;
    });
    if (span == near.spans.end() || place(ends.ends[2 * (&*span - first)]) > piece.w) return true;
    const FrontFacet& front = scan_.scene().facets[span->facet_index];
    const float along = front.normal.x() + front.normal.y() * piece.u + front.normal.z() * piece.w;
    const float q = -along / front.height_m;
    const float secant = std::sqrt(1.0F + piece.u * piece.u + piece.w * piece.w);
    return !(q > 0.0F) || secant / piece.q < secant / q - same_range_m_;
}

/// True if both slices show the same planes between the same ends midway.
bool AdaptiveSlices::alike(const SliceResult& a, const SliceResult& b) const {
    if (a.spans.size() != b.spans.size()) return false;
    const float most = same_place * (a.slice.w_high - a.slice.w_low);
    for (std::size_t i = 0; i < a.spans.size(); ++i) {
        const VisibleSpan& x = a.spans[i];
        const VisibleSpan& y = b.spans[i];
        const float farthest = std::min(x.facet_extent.range_m.to, y.facet_extent.range_m.to);
        if (!scan_.one_plane(x.facet_index, y.facet_index, farthest)) return false;
        for (const std::size_t end : {2 * i, 2 * i + 1}) {
            if (!(std::fabs(a.high.ends[end].w - b.low.ends[end].w) <= most)) return false;
        }
    }
    return true;
}

float AdaptiveSlices::min_width(std::uint32_t gap) const {
    const std::vector<Slice>& slices = scan_.frame().slices;
    return min_share * (slices[gap + 1].u - slices[gap].u);
}

float AdaptiveSlices::width(const Subgap& subgap) const {
    return results_[subgap.high].slice.u - results_[subgap.low].slice.u;
}

std::uint32_t AdaptiveSlices::new_slice() {
    if (used_ == results_.size()) results_.emplace_back();
    return used_++;
}

void AdaptiveSlices::collect_done() {
    done_.clear();
    for (std::uint32_t i = 0; i < used_; ++i)
        done_.push_back(&results_[i]);
    std::ranges::sort(done_, {}, [](const SliceResult* result) { return result->slice.u; });
    if (next_gap_ < scan_.frame().gaps()) {
        done_.pop_back();
        return;
    }
    SliceResult& last = results_[last_];
    move_ends(last.slice, last.spans, scan_.frame().beam_u.back(), last.high);
}

}  // namespace sonarsim
