#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/local_pose.h"
#include "visibility/slices/envelope.h"
#include "visibility/slices/moved_ends.h"
#include "visibility/slices/narrow_pieces.h"
#include "visibility/slices/reach.h"
#include "visibility/slices/setup.h"
#include "visibility/slices/slice_walk.h"

namespace sonarsim {

/// A slice and what is visible in it, from low w to high.
struct SeenSlice {
    Slice slice;
    std::vector<VisibleSpan> spans;
    MovedEnds low;  ///< moved to where the strip that it stands for begins, and ends
    MovedEnds high;
};

/// What is visible in the slices of a frame from one pose, and in any slice between them.
class FrameScan {
  public:
    /// The mesh, the scene and the frame must outlive it.
    FrameScan(const ClusterMesh& mesh, const Scene& scene, const SliceFrame& frame,
              const LocalPose& pose, float range_max_m);

    /// Sees the next slice of the frame, beginning with the first.
    void see_next(SeenSlice& out);

    /// The trapezoids that one of the two slices seen last meets. Appends to `out`.
    void around_last_gap(std::vector<std::uint32_t>& out) const { walk_.around_last_gap(out); }

    /// Finds all that slices within a gap may meet: `around`, the trapezoids that its own two
    /// slices meet, and those that lie between them.
    void find_candidates(std::uint32_t gap, std::span<const std::uint32_t> around,
                         std::vector<Candidate>& out);

    /// Sees the slice at u, which meets nothing but `candidates`.
    void see(float u, std::span<const Candidate> candidates, SeenSlice& out);

    /// The slices that are wanted within a gap, from low u to high.
    std::span<const WantedSlice> wanted_in(std::uint32_t gap) const;

    /// Whether two facets of the scene, at `range_m`, lie on one plane, of one material and
    /// instance.
    bool one_plane(std::uint32_t a, std::uint32_t b, float range_m) const;

    const SliceFrame& frame() const { return frame_; }
    const ClusterMesh& mesh() const { return mesh_; }
    const SliceScene& scene() const { return scene_; }

  private:
    void see(const Slice& slice, std::span<const Segment> segments, SeenSlice& out);

    const ClusterMesh& mesh_;
    const SliceFrame& frame_;
    SliceScene scene_;
    SliceSetup setup_;
    std::vector<WantedSlice> wanted_;
    Reaches reaches_;
    SliceWalk walk_;
    int next_ = 0;
    EnvelopeScratch envelope_;
    std::vector<Segment> segments_;
    std::optional<Groups> between_;  ///< indices into scene_.between by gap
    std::vector<std::uint32_t> facets_;
};

}  // namespace sonarsim
