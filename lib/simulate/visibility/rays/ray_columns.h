#pragma once

#include <cstdint>
#include <vector>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/rays/bent_rays.h"
#include "simulate/visibility/rays/sampling.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// Rays that sweep one column of the view, or an edge strip over a part of one.
struct RayColumn {
    int beam;
    float half_width;    ///< across, rad
    SinCosFloat across;  ///< the angle across that its rays share
    float along_min;
    float along_max;
    float step;  ///< spacing of its rays before gaps are split, rad
    int first;   ///< index of its first ray
    bool whole;  ///< a whole column of the view, not an edge strip
};

/// All rays that were cast for a view. The first `whole_columns` columns are those of the view, in
/// order, each with `Sampling::rays` consecutive rays; edge strips follow, sorted by beam.
struct RayColumns {
    std::vector<CastRay> rays;
    std::vector<RayTube> tubes;  ///< one for each ray where sound bends, else empty
    std::vector<RayColumn> columns;
    /// [whole_columns, Sampling::rays]: nonzero if edge strips leave the column only its middle
    /// strip.
    std::vector<std::uint8_t> narrowed;
    std::size_t whole_columns = 0;
    std::uint64_t dropped = 0;  ///< as in Samples
};

/// Beams [begin, end) of a view.
struct BeamRange {
    int begin;
    int end;
};

/// Casts rays along every column of these beams. Adds edge strips where neighbouring columns
/// disagree, and splits the gap between two neighbouring rays while its estimate is too uncertain.
RayColumns cast_ray_columns(const Caster& caster, const View& view, const LocalPose& pose,
                            const Sampling& sampling, BeamRange beams, const BentWater& water = {});

/// The surface that the columns of rays have met. Each ray represents a segment of its column as a
/// flat patch of the plane that it met. If the surface is continuous from one ray to the next,
/// their patches meet where the two planes do, so faceted surface is reproduced exactly; otherwise
/// they end half way. Appends the samples of `beams` to `samples`, which holds those of the earlier
/// beams.
void add_column_samples(const View& view, const Sampling& sampling, const RayColumns& columns,
                        BeamRange beams, Samples& samples);

}  // namespace sonarsim
