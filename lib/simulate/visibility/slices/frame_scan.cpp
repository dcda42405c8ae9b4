#include "simulate/visibility/slices/frame_scan.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// If a gap holds more triangles than this, only every n-th is used and stands for n of them: a
// finely cut surface has thousands, and the neighbouring slices predict it well.
constexpr std::uint32_t max_unseen = 16;

// Pieces per height of the view, and the most pieces of a triangle.
constexpr float per_height = 8.0F;
constexpr float max_pieces = 4.0F;

constexpr int slices_per_component = 4;

// Planes are equal if their normals differ by less than this, and their heights by less than this
// share of the distance: float corners of a flat wall differ by as much.
constexpr float max_tilt = 2e-5F;

Interval around(const Interval& a, const Interval& b) {
    return {std::min(a.from, b.from), std::max(a.to, b.to)};
}

bool touch(const VisibleSpan& a, const VisibleSpan& b) {
    return b.w_low - a.w_high <= 4e-6F * (1.0F + std::fabs(a.w_high));
}

Groups by_gap(const SliceScene& scene, const SliceFrame& frame) {
    std::vector<std::uint32_t> gaps;
    gaps.reserve(scene.in_gaps.size());
    for (const FacetInGap& noted : scene.in_gaps)
        gaps.push_back(noted.gap);
    return sort_into_groups(gaps, frame.gaps());
}

/// Appends the pieces of a triangle between two limits of w. The pieces are slabs of w, so that
/// nearly every piece is visible or hidden as a whole. `normal` is that of the triangle's plane, on
/// either side.
void add_unseen_pieces(const Corners& corners, const Eigen::Vector3f& normal, float reflection,
                       const Interval& view_w, std::vector<UnseenPiece>& out) {
    const Interval visible_u = u_between(corners, view_w);
    const auto [w_from, w_to] = std::minmax({corners[0].w, corners[1].w, corners[2].w});
    const Interval w{std::max(w_from, view_w.from), std::min(w_to, view_w.to)};
    const float height = -normal.dot(Eigen::Vector3f(corners[0].X, corners[0].U, corners[0].W));
    if (!(w.from < w.to) || height == 0.0F) return;
    const float pieces = std::clamp(
        std::ceil(per_height * (w.to - w.from) / (view_w.to - view_w.from)), 1.0F, max_pieces);
    const float step = (w.to - w.from) / pieces;
    for (int k = 0; k < static_cast<int>(pieces); ++k) {
        const float at = w.from + (static_cast<float>(k) + 0.5F) * step;
        const Interval across = u_between(corners, {at, at});
        if (!(across.from < across.to)) continue;
        const float u = 0.5F * (across.from + across.to);
        // On a plane -h q = n . (1, u, w), and dA = X^3 du dw / h.
        const auto q_at = [&](float v) -> float {
            return -(normal.x() + normal.y() * u + normal.z() * v) / height;
        };
        const auto range_at = [&](float v) -> float {
            return std::sqrt(1.0F + u * u + v * v) / q_at(v);
        };
        const float q = q_at(at);
        const float low = q_at(at - 0.5F * step);
        const float high = q_at(at + 0.5F * step);
        if (!(q > 0.0F && low > 0.0F && high > 0.0F)) continue;
        const auto [near, far] =
            std::minmax({range_at(at - 0.5F * step), range_at(at + 0.5F * step)});
        out.push_back({visible_u,
                       u,
                       at,
                       q,
                       (across.to - across.from) * step / (q * q * q * std::fabs(height)),
                       {near, far},
                       std::fabs(height),
                       reflection});
    }
}

}  // namespace

FrameScan::FrameScan(const ClusterMesh& mesh, const Scene& scene, const SliceFrame& frame,
                     const LocalPose& pose, float range_max_m)
    : mesh_(mesh),
      materials_(scene.materials),
      frame_(frame),
      setup_(mesh, frame, pose, range_max_m, scene_),
      facet_extents_(mesh, scene.vertices, setup_, scene_),
      walk_(scene_, frame) {
    setup_.run();
    by_gap_ = by_gap(scene_, frame_);
    request_slices();
}

/// Requests slices through the narrow components.
void FrameScan::request_slices() {
    const std::vector<Slice>& slices = frame_.slices;
    const auto gap_of = [&](float u) {
        const auto behind = std::ranges::upper_bound(slices, u, {}, &Slice::u);
        return static_cast<std::ptrdiff_t>(behind - slices.begin()) - 1;
    };
    const auto gaps = static_cast<std::ptrdiff_t>(frame_.gaps());
    for (const Interval& component : scene_.component_u) {
        if (!(component.from < component.to)) continue;  // out of view
        const std::ptrdiff_t gap = gap_of(component.from);
        const float width = component.to - component.from;
        if (gap < 0 || gap >= gaps || width > slices[gap + 1].u - slices[gap].u) continue;
        for (int k = 0; k < slices_per_component; ++k) {
            const float u =
                component.from + (static_cast<float>(k) + 0.5F) * width / slices_per_component;
            const std::ptrdiff_t at = gap_of(u);
            if (at < gaps) requested_.push_back({static_cast<std::uint32_t>(at), u});
        }
    }
    std::ranges::sort(requested_, {}, &RequestedSlice::u);
}

void FrameScan::scan_next(SliceResult& out) {
    const std::vector<Segment>& segments = walk_.step(next_);
    scan_slice(frame_.slices[next_++], segments, out);
}

void FrameScan::find_candidates(std::uint32_t gap, std::span<const std::uint32_t> around,
                                std::vector<std::uint32_t>& out) {
    out.assign(around.begin(), around.end());
    facets_.clear();
    for (std::uint32_t k = by_gap_.begin[gap]; k < by_gap_.begin[gap + 1]; ++k)
        facets_.push_back(scene_.in_gaps[by_gap_.items[k]].facet);
    // A triangle with two parts in this gap was noted twice.
    facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
    const auto first = static_cast<std::uint32_t>(scene_.trapezoids.size());
    setup_.add_between(facets_);
    for (auto i = first; i < scene_.trapezoids.size(); ++i) {
        const Trapezoid& t = scene_.trapezoids[i];
        if (frame_.slices[gap].u <= t.u_from && t.u_to <= frame_.slices[gap + 1].u)
            out.push_back(i);
    }
}

void FrameScan::find_unseen(std::uint32_t gap, std::vector<UnseenPiece>& out) {
    const std::uint32_t begin = by_gap_.begin[gap];
    const std::uint32_t end = by_gap_.begin[gap + 1];
    const std::uint32_t step = 1 + (end - begin) / max_unseen;
    const Interval w = w_over(frame_, {frame_.slices[gap].u, frame_.slices[gap + 1].u});
    for (std::uint32_t k = begin; k < end; k += step) {
        const FacetInGap& note = scene_.in_gaps[by_gap_.items[k]];
        if (!note.whole) continue;
        const SliceFacet& facet = mesh_.facets[note.facet];
        add_unseen_pieces(setup_.corners_of(note.facet), setup_.turned(facet.normal),
                          materials_[facet.material].reflection, w, out);
    }
    for (UnseenPiece& piece : out)
        piece.area_m2 *= static_cast<float>(step);
}

void FrameScan::scan_slice(float u, std::span<const std::uint32_t> candidates, SliceResult& out) {
    segments_at(scene_, u, candidates, places_, segments_);
    scan_slice(slice_at(frame_, u), segments_, out);
}

void FrameScan::scan_slice(const Slice& slice, std::span<const Segment> segments,
                           SliceResult& out) {
    out.slice = slice;
    visible_spans(segments, scene_, slice, facet_extents_, open_, out.spans);
    merge_coplanar(out.spans);
}

bool FrameScan::one_plane(std::uint32_t a, std::uint32_t b, float range_m) const {
    if (a == b) return true;
    const FrontFacet& f = scene_.facets[a];
    const FrontFacet& g = scene_.facets[b];
    if ((f.normal - g.normal).squaredNorm() > max_tilt * max_tilt) return false;
    if (std::fabs(f.height_m - g.height_m) > max_tilt * range_m) return false;
    const SliceFacet& s = mesh_.facets[f.facet];
    const SliceFacet& t = mesh_.facets[g.facet];
    return s.material == t.material && s.instance == t.instance;
}

/// Merges neighbouring spans in one plane with one material and instance: a flat wall is one span,
/// however it is divided into triangles.
void FrameScan::merge_coplanar(std::vector<VisibleSpan>& spans) const {
    if (spans.empty()) return;
    std::size_t last = 0;
    for (std::size_t i = 1; i < spans.size(); ++i) {
        VisibleSpan& a = spans[last];
        const VisibleSpan& b = spans[i];
        const float farthest = std::min(a.facet_extent.range_m.to, b.facet_extent.range_m.to);
        if (!touch(a, b) || !one_plane(a.facet_index, b.facet_index, farthest)) {
            spans[++last] = b;
            continue;
        }
        a.w_high = b.w_high;
        a.q_high = b.q_high;
        a.high = b.high;
        a.facet_extent.u = around(a.facet_extent.u, b.facet_extent.u);
        a.facet_extent.range_m = around(a.facet_extent.range_m, b.facet_extent.range_m);
    }
    spans.resize(last + 1);
}

std::span<const RequestedSlice> FrameScan::requested_in(std::uint32_t gap) const {
    const auto from = std::ranges::lower_bound(requested_, gap, {}, &RequestedSlice::gap);
    const auto to = std::ranges::upper_bound(requested_, gap, {}, &RequestedSlice::gap);
    return {from, to};
}

}  // namespace sonarsim
