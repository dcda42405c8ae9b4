#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/local_pose.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/scan.h"

namespace sonarsim {

/// The plane of a triangle that some slice meets, in the frame of the slices.
struct SeenFacet {
    Eigen::Vector3f normal;  ///< towards the sensor
    float height_m;          ///< of the sensor above the plane
    std::uint32_t facet;     ///< of ClusterMesh::facets
    Extent range_m;          ///< within which all of the triangle lies
};

/// Part of a triangle between two verticals of the picture plane. `at` and `slope` are lines over
/// u: w of the lower edge, w of the upper, and q = 1 / X along either. On a plane q is linear in u
/// and w, and an edge is a straight line.
struct alignas(16) Trapezoid {
    std::array<float, 4> at;  ///< at a corner of the edge, whose u is `anchor`
    std::array<float, 4> slope;
    std::array<float, 4> anchor;
    Extent low;          ///< of the lower edge
    Extent high;         ///< of the upper edge
    Extent ends;         ///< of the surface; infinite where it goes on with a neighbour
    std::uint32_t seen;  ///< index of its SeenFacet
    std::int32_t end;    ///< the first slice after it
};

/// What the slices of a frame meet.
/// A triangle that lies between two slices.
struct Between {
    std::int32_t slice;  ///< the one after it
    std::uint32_t piece;
    Extent u;
    Extent w;
};

struct SliceScene {
    std::vector<SeenFacet> facets;
    std::vector<Trapezoid> trapezoids;
    std::vector<std::uint32_t> order;  ///< of `trapezoids`, by the first slice that meets them
    std::vector<std::uint32_t> begin;  ///< slices + 1 offsets into `order`
    std::vector<Between> between;
    std::vector<bool> met;      ///< pieces of the mesh that some slice meets
    std::uint64_t dropped = 0;  ///< triangles seen edge-on to within rounding

    void clear();
};

/// Memory that the setup of one frame after the other reuses.
struct SetupScratch {
    std::vector<Eigen::Vector3f> points;
    std::vector<std::int32_t> first;  ///< slice of each trapezoid
    std::vector<std::int32_t> table;
};

/// Projects all triangles within `range_max_m` into the frame. `vertices` are the scene's.
void set_up_slices(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
                   const SliceFrame& frame, const LocalPose& pose, float range_max_m,
                   SetupScratch& scratch, SliceScene& out);

}  // namespace sonarsim
