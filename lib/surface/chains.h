#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "surface/angles.h"
#include "surface/caster.h"
#include "surface/view.h"

namespace sonarsim {

/// A sensor pose relative to the scene's local origin.
struct LocalPose {
    Eigen::Matrix3f rotation;  ///< R_local_sensor
    Eigen::Vector3f position;  ///< m
};

/// A split column is a wide strip between two narrow ones, each this share of its width. A bin is
/// as bright for a sliver of surface as for a full view, so what counts is that a silhouette within
/// the column has rays on both of its sides: equal thirds miss one in three, these one in ten.
inline constexpr float margin = 0.1F;

/// How densely a view is sampled.
struct Sampling {
    int columns = 1;                ///< per beam (of a fan), per side, or round the cone
    int chain = 32;                 ///< rays along a column before refinement
    int levels = 3;                 ///< bisections where neighbours along a column disagree
    bool split = true;              ///< columns whose neighbours disagree are seen in strips
    float tolerance_slope = 0.03F;  ///< to which comes this share of the step in range
    float tolerance_m = 0.0F;       ///< by how much a neighbour's plane may miss a range
    float tolerance_cosine = 0.1F;  ///< by which share of itself a cosine of incidence may be off
};

/// The density that meets the view's error goal, by the figures of the speed-against-error report.
Sampling sampling_for(const View& view);

/// A ray and the plane of what it met, in the sensor frame.
struct ChainNode {
    static constexpr int none = -1;

    Eigen::Vector3f direction;
    float along;                                       ///< angle, rad
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< of the sensor above the plane
    float cosine = 0.0F;                               ///< of incidence
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    int next = none;     ///< the next node along the chain
    bool joined = true;  ///< this node and the next lie on one surface, as far as is known

    bool missed() const { return facet == Caster::nothing; }
    float range_m() const { return height_m / cosine; }
};

/// A chain of nodes that sweeps a strip of a beam.
struct Chain {
    int beam;
    float half_width;  ///< across, rad
    Turn across;       ///< of the chain's rays
    float along_min;
    float along_max;
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

/// Sees the view as chains of rays: along each column a chain, bisected where two neighbours do
/// not lie on one surface; where neighbouring columns disagree, their margins as well.
Chains cast_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling);

}  // namespace sonarsim
