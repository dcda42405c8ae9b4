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

/// A piece of visible surface and its echo.
struct EchoPatch {
    Eigen::Vector3f position, edge_u, edge_v;  ///< as those of Sample
    double echo;
    const Sample* sample;
};

/// The echoes of a traced ping where a beam and a bin receive them, before beam pattern and pulse
/// spread them and without random terms: what labels are made of. Echoes of one bin are in one
/// unit. Samples are those of the traced ping, which must outlive this, or of
/// `target_samples`.
struct SurfaceEchoes {
    SurfaceEchoes() = default;
    SurfaceEchoes(SurfaceEchoes&&) = default;  ///< a copy would point into the original

    BeamEchoes direct;
    BeamEchoes multipath;  ///< the samples are those that mirror the sound
    /// The visible surface, sorted by beam; empty if it was not asked for.
    std::vector<EchoPatch> patches;
    std::vector<std::uint32_t> patch_begin;  ///< beams + 1 offsets into `patches`
    std::vector<Sample> target_samples;      ///< one for each facet of TracedPing::targets
    /// The beams of a line array; empty: those of the view.
    ConeBeams cones;

    std::span<const EchoPatch> patches_of(int beam) const {
        return {patches.data() + patch_begin[beam], patches.data() + patch_begin[beam + 1]};
    }
};

}  // namespace sonarsim
