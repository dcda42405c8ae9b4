#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "visibility/local_pose.h"
#include "visibility/slices/clusters.h"
#include "visibility/view.h"

namespace sonarsim {

/// A part of a triangle about as deep as a range bin and no wider than a beam.
struct BinPiece {
    std::array<Eigen::Vector3f, 3> corners;  ///< sensor frame, m
    float area_m2;
    std::uint32_t facet;  ///< index into ClusterMesh::facets
};

/// The pieces of all triangles that may be in a view, visible or not, by the bin of their middle.
struct BinPieces {
    std::vector<BinPiece> pieces;      ///< bin after bin
    std::vector<std::uint32_t> bins;   ///< [beams, range_bins] index of each bin with pieces
    std::vector<std::uint32_t> begin;  ///< bins + 1 offsets into `pieces`
    std::vector<float> area_m2;        ///< sum over the pieces of each bin
};

/// Cuts the triangles of a mesh into pieces; nothing if there are more than a fixed number.
std::optional<BinPieces> bin_pieces(const ClusterMesh& mesh, const View& view,
                                    const LocalPose& pose);

}  // namespace sonarsim
