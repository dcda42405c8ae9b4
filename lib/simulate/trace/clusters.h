#pragma once

#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The greatest distances between the samples of a cluster.
struct ClusterLimits {
    int epsilon_bins = 0;       ///< in range, beam and elevation; 0: every sample by itself
    float delta_cosine = 1.0F;  ///< least cosine between normals
};

/// Samples grouped so that one ray may represent a group.
struct Clusters {
    std::vector<std::uint32_t> members;  ///< indices of samples, cluster after cluster
    std::vector<std::uint32_t> begin;    ///< clusters + 1 offsets into `members`

    std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
    std::span<const std::uint32_t> of(std::size_t cluster) const {
        return {members.data() + begin[cluster], members.data() + begin[cluster + 1]};
    }
};

/// Groups the samples within the view's range: Algorithm 1, lines 9 to 15. The bins of range, beam
/// and elevation are cut into tiles of `epsilon_bins` each way; samples of one tile whose normals
/// lie within delta of the normal of the group's first sample form a group. The paper's double loop
/// over all leaves makes balls instead of tiles, in quadratic time; this takes linear time.
Clusters cluster_samples(const View& view, const Samples& samples, const ClusterLimits& limits);

}  // namespace sonarsim
