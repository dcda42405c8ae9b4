// The part of AdaptiveSlices that checks beams.

#include <algorithm>

#include "core/random.h"
#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/kept_gaps.h"

namespace sonarsim {

namespace {

constexpr PhiloxKey check_key{0x63686563U, 0};

}  // namespace

/// True if both slices predict the same, and no triangle lies between the slices of the frame.
bool AdaptiveSlices::certain(const Subgap& subgap) const {
    return !(subgap.difference > 0.0F) && !scan_.has_triangles(subgap.gap);
}

bool AdaptiveSlices::uncertain() const {
    return !std::ranges::all_of(subgaps_, [&](const Subgap& subgap) { return certain(subgap); });
}

void AdaptiveSlices::keep(KeptGaps& out) const {
    out.beams.push_back(
        {first_gap_, next_gap_, out.slices.size(), out.unseen.size(), last_difference_});
    out.subgaps.add(subgaps_);
    for (std::uint32_t i = 0; i < used_; ++i) {
        out.slices.push_back(results_[i].slice);
        out.spans.add(results_[i].spans);
    }
    for (std::uint32_t gap = first_gap_; gap < next_gap_; ++gap) {
        const AroundGap& around = around_[gap - first_gap_];
        out.of_slices.add(around.of_slices);
        out.all.add(around.all);
        out.unseen.add(around.unseen);
    }
}

void AdaptiveSlices::restore(const KeptGaps& kept, std::size_t index) {
    const auto assign = [](auto& to, auto row) { to.assign(row.begin(), row.end()); };
    const KeptGaps::Beam& beam = kept.beams[index];
    const bool is_last = index + 1 == kept.beams.size();
    const std::size_t end = is_last ? kept.slices.size() : kept.beams[index + 1].first_slice;
    first_gap_ = beam.first_gap;
    next_gap_ = beam.next_gap;
    assign(subgaps_, kept.subgaps[index]);
    used_ = 0;
    for (std::size_t i = beam.first_slice; i < end; ++i) {
        SliceResult& result = results_[new_slice()];
        result.slice = kept.slices[i];
        assign(result.spans, kept.spans[i]);
    }
    for (std::uint32_t k = 0; k < next_gap_ - first_gap_; ++k) {
        assign(around_[k].of_slices, kept.of_slices[beam.first_around + k]);
        assign(around_[k].all, kept.all[beam.first_around + k]);
        assign(around_[k].unseen, kept.unseen[beam.first_around + k]);
    }
}

void AdaptiveSlices::scan_check() {
    check_used_ = 0;
    // Room for all: the addresses of the results are kept.
    if (check_.size() < 2 * subgaps_.size()) check_.resize(2 * subgaps_.size());
    for (std::uint32_t i = 0; i < subgaps_.size(); ++i) {
        const Subgap& subgap = subgaps_[i];
        if (certain(subgap)) continue;
        const PhiloxBlock word = philox({first_gap_, i, 0, 0}, check_key);
        const float u = results_[subgap.low].slice.u + unit_float(word.x0) * width(subgap);
        scan_check_at(u, subgap);
        const float through = through_unseen(subgap, unit_float(word.x1));
        if (through != u) scan_check_at(through, subgap);
    }
}

/// Scans a slice between those of a subgap.
void AdaptiveSlices::scan_check_at(float u, const Subgap& subgap) {
    if (!(results_[subgap.low].slice.u < u && u < results_[subgap.high].slice.u)) return;
    SliceResult& at = check_[check_used_++];
    scan_.scan_slice(u, candidates(subgap.gap), at);
    checked_.push_back(&at);
}

/// Picks one of the pieces in a subgap that no slice meets, at a share of their summed area, and
/// returns its u; the begin of the subgap if there are none.
float AdaptiveSlices::through_unseen(const Subgap& subgap, float share) const {
    const float low = results_[subgap.low].slice.u;
    const float high = results_[subgap.high].slice.u;
    const std::vector<UnseenPiece>& unseen = around_[subgap.gap - first_gap_].unseen;
    const auto inside = [&](const UnseenPiece& piece) { return low < piece.u && piece.u < high; };
    float area = 0.0F;
    for (const UnseenPiece& piece : unseen) {
        if (inside(piece)) area += piece.area_m2;
    }
    float left = share * area;
    float u = low;
    for (const UnseenPiece& piece : unseen) {
        if (!inside(piece)) continue;
        u = piece.u;
        left -= piece.area_m2;
        if (left < 0.0F) break;
    }
    return u;
}

std::span<const Strip> AdaptiveSlices::check_strips() {
    checked_.clear();
    for (std::uint32_t i = 0; i < used_; ++i)
        checked_.push_back(&results_[i]);
    scan_check();
    std::ranges::sort(checked_, {}, [](const SliceResult* result) { return result->slice.u; });
    const std::size_t count = checked_.size();
    if (borders_.size() < 2 * count) borders_.resize(2 * count);
    strips_.clear();
    float border = beam_border(first_gap_);
    for (std::size_t i = 0; i < count; ++i) {
        const SliceResult& at = *checked_[i];
        move_ends(at.slice, at.spans, border, borders_[2 * i]);
        border = beam_border(next_gap_);
        if (i + 1 < count) border = std::min(strip_border(at, *checked_[i + 1]), border);
        move_ends(at.slice, at.spans, border, borders_[2 * i + 1]);
        strips_.push_back({&at, &borders_[2 * i], &borders_[2 * i + 1]});
    }
    return strips_;
}

/// The border between beams at the begin of a gap, or the frame's own border.
float AdaptiveSlices::beam_border(std::uint32_t gap) const {
    const SliceFrame& frame = scan_.frame();
    const auto per_beam = static_cast<std::uint32_t>(frame.slices_per_beam);
    return frame.beam_u[(gap + per_beam - 1) / per_beam];
}

}  // namespace sonarsim
