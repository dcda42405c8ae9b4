#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/groups.h"
#include "visibility/local_pose.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/edge_line.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/slice_finder.h"

namespace sonarsim {

/// The plane of a triangle that some slice meets, in the frame of the slices.
struct SeenFacet {
    Eigen::Vector3f normal;  ///< towards the sensor
    float height_m;          ///< of the sensor above the plane
    std::uint32_t facet;     ///< of ClusterMesh::facets
};

/// Part of a triangle between two verticals of the picture plane. Its lower and its upper edge are
/// lines over u, and so is q = 1 / X along either: on a plane q is linear in u and w.
struct Trapezoid {
    EdgeLine low;
    EdgeLine high;
    float u_from;
    float u_to;          ///< exclusive
    std::uint32_t seen;  ///< index of its SeenFacet
};

/// A triangle that lies between two slices.
struct Between {
    std::uint32_t facet;  ///< of ClusterMesh::facets
    std::uint32_t gap;
};

/// What the slices of a frame meet.
struct SliceScene {
    std::vector<SeenFacet> facets;
    std::vector<Trapezoid> trapezoids;
    Groups by_slice;  ///< trapezoids by the first slice that meets them
    std::vector<Between> between;
    std::vector<Extent> piece_u;  ///< of the triangles in view; of the other pieces from > to
    std::uint64_t dropped = 0;    ///< triangles seen edge-on to within rounding

    void clear(std::uint32_t pieces);
};

/// Projects the triangles of a mesh into a frame.
class SliceSetup {
  public:
    /// All arguments must outlive it. Nothing beyond `range_max_m` is projected.
    SliceSetup(const ClusterMesh& mesh, const SliceFrame& frame, const LocalPose& pose,
               float range_max_m, SliceScene& out);

    /// Fills `out`: trapezoids for what a slice of the frame meets, notes for what lies between.
    void run();

    /// Adds the trapezoids of triangles that lie between two slices.
    void add_between(std::span<const std::uint32_t> facets);

    /// The corners of a triangle of the mesh in the frame.
    Corners corners_of(std::uint32_t facet) const;

    float nearest_m() const { return nearest_m_; }

    /// A point of the scene in the frame.
    Eigen::Vector3f in_frame(const Eigen::Vector3f& local) const {
        return R_frame_local_ * (local - position_);
    }

  private:
    bool in_view(const Cluster& cluster) const;
    void add_cluster(const Cluster& cluster);
    void add_triangle(const Corners& corners, std::uint32_t facet);
    void add_part_in_front(const Corners& corners, std::uint32_t facet);
    void widen_piece(std::uint32_t facet, const Extent& by);
    bool see(std::uint32_t facet, const Corner& corner);
    void add_trapezoid(const EdgeLine& low, const EdgeLine& high, float from, float to);

    const ClusterMesh& mesh_;
    const SliceFrame& frame_;
    const Eigen::Matrix3f R_frame_local_;
    const Eigen::Vector3f position_;
    const float reach_m_;
    const float nearest_m_;
    const float u_low_;
    const float u_high_;
    const SliceFinder find_slice_;
    SliceScene& out_;
    std::vector<Corner> cluster_corners_;
    std::vector<std::uint32_t> first_slice_;  ///< of each trapezoid
    bool lazy_ = false;                       ///< triangles between slices are wanted
};

}  // namespace sonarsim
