#pragma once

#include <span>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/visibility/local_pose.h"
#include "simulate/visibility/slices/edge_line.h"
#include "simulate/visibility/slices/envelope.h"
#include "simulate/visibility/slices/facet_extent.h"
#include "simulate/visibility/slices/moved_ends.h"
#include "simulate/visibility/slices/setup.h"
#include "simulate/visibility/slices/slice_walk.h"

namespace sonarsim {

/// A slice and its visible spans, from low w to high.
struct SliceResult {
    Slice slice;
    std::vector<VisibleSpan> spans;
    MovedEnds low;  ///< moved to the begin of its strip
    MovedEnds high;
};

/// A piece of a triangle that lies between two slices, so that no slice meets it.
struct UnseenPiece {
    Interval facet_u;  ///< extent of its triangle within the view
    float u, w, q;     ///< its middle; q = 1 / X
    float area_m2;
    Interval range_m;
    float height_m;  ///< distance of the sensor from its plane
    float reflection;
};

/// A slice that is requested within a gap.
struct RequestedSlice {
    std::uint32_t gap;
    float u;
};

/// Scans the slices of a frame from one pose, and any slice between them, for visible surface.
class FrameScan {
  public:
    /// The mesh, the scene and the frame must outlive it.
    FrameScan(const ClusterMesh& mesh, const Scene& scene, const SliceFrame& frame,
              const LocalPose& pose, float range_max_m);

    /// Scans the next slice of the frame, beginning with the first.
    void scan_next(SliceResult& out);

    /// Appends the trapezoids that one of the last two slices meets to `out`.
    void around_last_gap(std::vector<std::uint32_t>& out) const { walk_.around_last_gap(out); }

    /// Finds all trapezoids that slices within a gap may meet: `around`, which its own two slices
    /// meet, and those that lie between them.
    void find_candidates(std::uint32_t gap, std::span<const std::uint32_t> around,
                         std::vector<std::uint32_t>& out);

    /// Finds pieces of the triangles that lie between the slices of a gap; `out` is empty before.
    void find_unseen(std::uint32_t gap, std::vector<UnseenPiece>& out);

    /// Scans the slice at u, which may meet only `candidates`.
    void scan_slice(float u, std::span<const std::uint32_t> candidates, SliceResult& out);

    /// The slices requested within a gap, from low u to high: those through the components of the
    /// mesh that are narrower than a gap, such as a wire or a small ball. The echo of such a
    /// component is the mean over facets of all orientations, but a slice of the frame meets one
    /// facet or none.
    std::span<const RequestedSlice> requested_in(std::uint32_t gap) const;

    /// True if two facets of the scene, at `range_m`, lie in one plane and have one material and
    /// instance.
    bool one_plane(std::uint32_t a, std::uint32_t b, float range_m) const;

    /// The extent of the facet of SliceScene::facets[facet_index].
    const FacetExtent& facet_extent(std::uint32_t facet_index) const {
        return facet_extents_.of(facet_index);
    }

    const SliceFrame& frame() const { return frame_; }
    const ClusterMesh& mesh() const { return mesh_; }
    const SliceScene& scene() const { return scene_; }

  private:
    void request_slices();
    void scan_slice(const Slice& slice, std::span<const Segment> segments, SliceResult& out);
    void merge_coplanar(std::vector<VisibleSpan>& spans) const;

    const ClusterMesh& mesh_;
    std::span<const Material> materials_;
    const SliceFrame& frame_;
    SliceScene scene_;
    SliceSetup setup_;
    std::vector<RequestedSlice> requested_;  ///< from low u to high
    mutable FacetExtents facet_extents_;     ///< computed on demand
    SliceWalk walk_;
    int next_ = 0;
    std::vector<std::uint32_t> open_;  ///< memory of visible_spans()
    std::vector<std::uint64_t> places_;
    std::vector<Segment> segments_;
    Groups by_gap_;  ///< indices into scene_.in_gaps by gap
    std::vector<std::uint32_t> facets_;
};

}  // namespace sonarsim
