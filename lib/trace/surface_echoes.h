#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/cone_beams.h"
#include "trace/range_boxes.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Echoes by beam, and the samples that they come from.
struct BeamEchoes {
    RangeBoxes boxes;  ///< sorted by beam
    std::vector<const Sample*> sample;
    std::vector<std::uint32_t> beam_begin;  ///< beams + 1 offsets into `boxes`
};

/// The echo of a piece of visible surface in a beam.
struct PatchEcho {
    std::uint32_t beam;
    double echo;
};

/// A piece of visible surface. A line array may receive it in several beams.
struct EchoPatch {
    Eigen::Vector3f position, edge_u, edge_v;    ///< as in Sample
    std::uint32_t echo_begin = 0, echo_end = 0;  ///< its echoes in `patch_echoes`
    const Sample* sample;
};

/// The echoes of a traced ping by beam and bin, before beam pattern and pulse spread them and
/// without random terms. Labels are made from them. Echoes of one bin are in one unit. Samples are
/// those of the traced ping, which must outlive this, or of `target_samples`.
struct SurfaceEchoes {
    SurfaceEchoes() = default;
    SurfaceEchoes(SurfaceEchoes&&) = default;  ///< a copy would point into the original

    BeamEchoes direct;
    BeamEchoes multipath;  ///< the samples are those that reflect the sound
    /// The visible surface; empty if it was not asked for.
    std::vector<EchoPatch> patches;
    std::vector<PatchEcho> patch_echoes;
    /// beams + 1 offsets into `patches`, if these are sorted by beam and have one echo each; else
    /// empty.
    std::vector<std::uint32_t> patch_begin;
    std::vector<Sample> target_samples;  ///< one for each facet of TracedPing::targets
    /// The beams of a line array; empty: those of the view.
    ConeBeams cones;
    /// True if samples without a direct echo lie in side lobes; labels leave them out.
    bool main_lobe_alone = false;
};

}  // namespace sonarsim
