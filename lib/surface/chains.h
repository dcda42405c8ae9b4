#pragma once

#include <Eigen/Core>

#include "surface/caster.h"
#include "surface/surface.h"

namespace sonarsim {

/// A sensor pose relative to the scene's local origin.
struct LocalPose {
    Eigen::Matrix3f rotation;  ///< R_local_sensor
    Eigen::Vector3f position;  ///< m
};

/// How densely a view is sampled.
struct Sampling {
    int chain = 32;                 ///< rays in elevation per beam before refinement
    int levels = 3;                 ///< bisections where neighbours in elevation disagree
    bool split_beams = true;        ///< beams whose neighbours disagree are seen in thirds
    float tolerance_m = 0.0F;       ///< by how much a neighbour's plane may miss a range
    float tolerance_cosine = 0.1F;  ///< by how much the cosines of incidence may differ
};

/// The density that meets the view's error goal, by the figures of the speed-against-error report.
Sampling sampling_for(const View& view);

/// Sees the view as chains of rays: in each beam a chain of rays in elevation, bisected where two
/// neighbours do not lie on one surface. Every ray stands for the part of its beam that is nearer
/// to it than to its neighbours, as a flat piece of the facet that it met.
void sample_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling, Samples& samples);

}  // namespace sonarsim
