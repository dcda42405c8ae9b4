#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/groups.h"
#include "core/sorted_table.h"
#include "simulate/visibility/local_pose.h"
#include "simulate/visibility/clusters.h"
#include "simulate/visibility/slices/edge_line.h"
#include "simulate/visibility/slices/slice_frames.h"

namespace sonarsim {

/// The plane of a triangle that some slice meets, in the frame of the slices.
struct FrontFacet {
    Eigen::Vector3f normal;  ///< towards the sensor
    float height_m;          ///< distance of the sensor from the plane
    std::uint32_t facet;     ///< index into ClusterMesh::facets
};

/// Part of a triangle between two verticals of the picture plane. Its lower and its upper edge are
/// linear in u, and so is q = 1 / X along each: on a plane q is linear in u and w.
struct Trapezoid {
    EdgeLine low;
    EdgeLine high;
    float u_from;
    float u_to;                 ///< exclusive
    std::uint32_t facet_index;  ///< index of its FrontFacet
};

/// A triangle that lies wholly or in part between two slices.
struct FacetInGap {
    std::uint32_t facet;  ///< index into ClusterMesh::facets
    std::uint32_t gap;
    bool whole;  ///< its whole part in view lies in the gap
};

/// The facets and trapezoids that the slices of a frame meet.
struct SliceScene {
    std::vector<FrontFacet> facets;
    std::vector<Trapezoid> trapezoids;
    Groups by_slice;  ///< trapezoids by the first slice that meets them
    std::vector<FacetInGap> in_gaps;
    std::vector<Interval> component_u;  ///< extent by component; from > to: out of view
    std::uint64_t dropped = 0;          ///< triangles that are edge-on to within rounding

    void clear(std::uint32_t components);
};

/// Projects the triangles of a mesh into a frame.
class SliceSetup {
  public:
    /// All arguments must outlive it. Triangles beyond `range_max_m` are ignored.
    SliceSetup(const ClusterMesh& mesh, const SliceFrame& frame, const LocalPose& pose,
               float range_max_m, SliceScene& out);

    /// Fills `out`: trapezoids for the triangles that a slice of the frame meets, notes for those
    /// between slices.
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

    /// A direction of the scene in the frame.
    Eigen::Vector3f turned(const Eigen::Vector3f& local) const { return R_frame_local_ * local; }

  private:
    /// The first slices at or behind either end of a part in u; if equal, no slice meets the part.
    struct SlicesOfPart {
        std::uint32_t first;
        std::uint32_t next;
    };

    bool in_view(const TriangleCluster& cluster) const;
    void add_cluster(const TriangleCluster& cluster);
    void add_triangle(const Corners& corners, std::uint32_t facet);
    void note_clipped(const Corners& corners, std::uint32_t facet, Interval u);
    void add_part_in_front(const Corners& corners, std::uint32_t facet);
    void widen_component(std::uint32_t facet, const Interval& by);
    bool add_facet(std::uint32_t facet, const Corner& corner);
    bool wants_part(const Interval& u, const SlicesOfPart& slices);
    void add_trapezoid(const EdgeLine& low, const EdgeLine& high, const Interval& u);

    const ClusterMesh& mesh_;
    const SliceFrame& frame_;
    const Eigen::Matrix3f R_frame_local_;
    const Eigen::Vector3f position_;
    const float reach_m_;
    const float nearest_m_;
    const float u_low_;
    const float u_high_;
    const SortedTable find_slice_;  ///< the first slice at or behind a u
    SliceScene& out_;
    std::vector<Corner> cluster_corners_;
    std::vector<std::uint32_t> first_slice_;  ///< first slice that meets each trapezoid
    bool lazy_ = false;                       ///< add_between() is running
};

}  // namespace sonarsim
