#include "visibility/slices/frame_scan.h"

#include <algorithm>

#include "visibility/slices/merge_spans.h"

namespace sonarsim {

namespace {

// If a gap holds more triangles than this, only every n-th is used and stands for n of them: a
// finely cut surface has thousands, and the neighbouring slices predict it well.
constexpr std::uint32_t most_unseen = 16;

Groups by_gap(const SliceScene& scene, const SliceFrame& frame) {
    std::vector<std::uint32_t> gaps;
    gaps.reserve(scene.in_gaps.size());
    for (const FacetInGap& noted : scene.in_gaps)
        gaps.push_back(noted.gap);
    return sort_into_groups(gaps, frame.gaps());
}

}  // namespace

FrameScan::FrameScan(const ClusterMesh& mesh, const Scene& scene, const SliceFrame& frame,
                     const LocalPose& pose, float range_max_m)
    : mesh_(mesh),
      materials_(scene.materials),
      frame_(frame),
      setup_(mesh, frame, pose, range_max_m, scene_),
      facet_extents_(mesh, scene.vertices, setup_, scene_) {
    setup_.run();
    requested_ = slices_through_narrow_components(scene_, frame_);
    walk_.start(scene_, frame_);
}

void FrameScan::scan_next(SliceResult& out) {
    const std::vector<Segment>& segments = walk_.step(next_);
    scan_slice(frame_.slices[next_++], segments, out);
}

void FrameScan::find_candidates(std::uint32_t gap, std::span<const std::uint32_t> around,
                                std::vector<Candidate>& out) {
    out.clear();
    for (const std::uint32_t trapezoid : around)
        out.push_back(candidate(scene_, trapezoid));
    const Groups& notes = notes_by_gap();
    facets_.clear();
    for (std::uint32_t k = notes.begin[gap]; k < notes.begin[gap + 1]; ++k)
        facets_.push_back(scene_.in_gaps[notes.items[k]].facet);
    // A triangle with two parts in this gap was noted twice.
    facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
    const auto first = static_cast<std::uint32_t>(scene_.trapezoids.size());
    setup_.add_between(facets_);
    for (auto i = first; i < scene_.trapezoids.size(); ++i) {
        const Candidate c = candidate(scene_, i);
        if (frame_.slices[gap].u <= c.u_from && c.u_to <= frame_.slices[gap + 1].u)
            out.push_back(c);
    }
}

const Groups& FrameScan::notes_by_gap() {
    if (!by_gap_) by_gap_ = by_gap(scene_, frame_);
    return *by_gap_;
}

void FrameScan::find_unseen(std::uint32_t gap, std::vector<UnseenPiece>& out) {
    const Groups& notes = notes_by_gap();
    const std::uint32_t begin = notes.begin[gap];
    const std::uint32_t end = notes.begin[gap + 1];
    const std::uint32_t step = 1 + (end - begin) / most_unseen;
    const Interval w = w_over(frame_, {frame_.slices[gap].u, frame_.slices[gap + 1].u});
    for (std::uint32_t k = begin; k < end; k += step) {
        const FacetInGap& note = scene_.in_gaps[notes.items[k]];
        if (!note.whole) continue;
        const SliceFacet& facet = mesh_.facets[note.facet];
        add_unseen_pieces(setup_.corners_of(note.facet), setup_.turned(facet.normal),
                          materials_[facet.material].reflection, w, out);
    }
    for (UnseenPiece& piece : out)
        piece.area_m2 *= static_cast<float>(step);
}

void FrameScan::scan_slice(float u, std::span<const Candidate> candidates, SliceResult& out) {
    segments_at(scene_, u, candidates, places_, segments_);
    scan_slice(slice_at(frame_, u), segments_, out);
}

void FrameScan::scan_slice(const Slice& slice, std::span<const Segment> segments,
                           SliceResult& out) {
    out.slice = slice;
    visible_spans(segments, scene_, slice, facet_extents_, envelope_, out.spans);
    merge_coplanar_spans(mesh_, scene_, out.spans);
}

bool FrameScan::one_plane(std::uint32_t a, std::uint32_t b, float range_m) const {
    return sonarsim::one_plane(mesh_, scene_, a, b, range_m);
}

std::span<const RequestedSlice> FrameScan::requested_in(std::uint32_t gap) const {
    const auto from = std::ranges::lower_bound(requested_, gap, {}, &RequestedSlice::gap);
    const auto to = std::ranges::upper_bound(requested_, gap, {}, &RequestedSlice::gap);
    return {from, to};
}

}  // namespace sonarsim
