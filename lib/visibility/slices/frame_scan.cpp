#include "visibility/slices/frame_scan.h"

#include <algorithm>

#include "visibility/slices/merge_spans.h"

namespace sonarsim {

namespace {

Groups by_gap(const SliceScene& scene, const SliceFrame& frame) {
    std::vector<std::uint32_t> gaps;
    gaps.reserve(scene.between.size());
    for (const Between& between : scene.between)
        gaps.push_back(between.gap);
    return sort_into_groups(gaps, frame.gaps());
}

}  // namespace

FrameScan::FrameScan(const ClusterMesh& mesh, const Scene& scene, const SliceFrame& frame,
                     const LocalPose& pose, float range_max_m)
    : mesh_(mesh),
      frame_(frame),
      setup_(mesh, frame, pose, range_max_m, scene_),
      reaches_(mesh, scene.vertices, setup_, scene_) {
    setup_.run();
    wanted_ = slices_through_narrow_pieces(scene_, frame_);
    walk_.start(scene_, frame_);
}

void FrameScan::see_next(SeenSlice& out) {
    const std::vector<Segment>& segments = walk_.step(next_);
    see(frame_.slices[next_++], segments, out);
}

void FrameScan::find_candidates(std::uint32_t gap, std::span<const std::uint32_t> around,
                                std::vector<Candidate>& out) {
    out.clear();
    for (const std::uint32_t trapezoid : around)
        out.push_back(candidate(scene_, trapezoid));
    if (!between_) between_ = by_gap(scene_, frame_);
    facets_.clear();
    for (std::uint32_t k = between_->begin[gap]; k < between_->begin[gap + 1]; ++k)
        facets_.push_back(scene_.between[between_->items[k]].facet);
    // A triangle of which two parts lie here was noted twice.
    facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
    const auto first = static_cast<std::uint32_t>(scene_.trapezoids.size());
    setup_.add_between(facets_);
    for (auto i = first; i < scene_.trapezoids.size(); ++i) {
        const Candidate c = candidate(scene_, i);
        if (frame_.slices[gap].u <= c.u_from && c.u_to <= frame_.slices[gap + 1].u)
            out.push_back(c);
    }
}

void FrameScan::see(float u, std::span<const Candidate> candidates, SeenSlice& out) {
    segments_at(scene_, u, candidates, segments_);
    see(slice_at(frame_, u), segments_, out);
}

void FrameScan::see(const Slice& slice, std::span<const Segment> segments, SeenSlice& out) {
    out.slice = slice;
    visible_spans(segments, scene_, slice, reaches_, envelope_, out.spans);
    merge_coplanar_spans(mesh_, scene_, out.spans);
}

bool FrameScan::one_plane(std::uint32_t a, std::uint32_t b, float range_m) const {
    return sonarsim::one_plane(mesh_, scene_, a, b, range_m);
}

std::span<const WantedSlice> FrameScan::wanted_in(std::uint32_t gap) const {
    const auto from = std::ranges::lower_bound(wanted_, gap, {}, &WantedSlice::gap);
    const auto to = std::ranges::upper_bound(wanted_, gap, {}, &WantedSlice::gap);
    return {from, to};
}

}  // namespace sonarsim
