#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "visibility/angles.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/rays/sampling.h"
#include "visibility/view.h"

namespace sonarsim {

/// A ray and the plane of what it met, in the sensor frame.
struct ChainNode {
    static constexpr int none = -1;

    Eigen::Vector3f direction;
    float along;                                       ///< angle, rad
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< of the sensor above the plane
    float cosine = 0.0F;                               ///< of incidence
    float range_m = 0.0F;
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    int next = none;      ///< the next node along the chain
    bool joined = true;   ///< the surface goes on from this node to the next, as far as is known
    float border = 0.5F;  ///< where this node gives way to the next, as a share of the way

    bool missed() const { return facet == Caster::nothing; }
};

/// A chain of nodes that sweeps a strip of a beam.
struct Chain {
    int beam;
    float half_width;  ///< across, rad
    Turn across;       ///< of the chain's rays
    float along_min;
    float along_max;
    float step;  ///< between its rays before refinement, rad
    int first;   ///< node
    bool whole;  ///< a whole column, not a margin over part of it
};

/// All that was seen of a view. The first chains are the columns in order, each with
/// `Sampling::chain` nodes in a row; the margins of columns follow, sorted by beam.
struct Chains {
    std::vector<ChainNode> nodes;
    std::vector<Chain> chains;
    std::vector<std::uint8_t> split;  ///< [columns, Sampling::chain]: seen in strips
    std::size_t columns = 0;
    std::uint64_t dropped = 0;  ///< as in Samples
};

/// Sees the view as chains of rays: along each column a chain, split between two neighbours for as
/// long as too much is at stake there; where neighbouring columns disagree, their margins as well.
Chains cast_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling);

}  // namespace sonarsim
