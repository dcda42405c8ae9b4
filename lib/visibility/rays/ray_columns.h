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

/// A ray of a column and the plane of the facet that it met, in the sensor frame.
struct CastRay {
    static constexpr int none = -1;

    Eigen::Vector3f direction;
    float along;                                       ///< its angle along the column, rad
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< of the sensor above the plane
    float cosine = 0.0F;                               ///< of the angle of incidence
    float range_m = 0.0F;
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    int next = none;         ///< index of the next ray along the column
    bool continuous = true;  ///< the surface continues from this ray to the next, as far as known
    float border = 0.5F;     ///< where this ray's part ends, as a share of the way to the next

    bool missed() const { return facet == Caster::nothing; }
};

/// Rays that sweep one column of the view, or an edge strip over a part of one.
struct RayColumn {
    int beam;
    float half_width;    ///< across, rad
    SinCosFloat across;  ///< of the angle across that its rays share
    float along_min;
    float along_max;
    float step;  ///< between its rays before gaps are split, rad
    int first;   ///< index of its first ray
    bool whole;  ///< a whole column of the view, not an edge strip
};

/// All rays that were cast for a view. The first `whole_columns` columns are those of the view, in
/// order, each with `Sampling::rays` rays in a row; edge strips follow, sorted by beam.
struct RayColumns {
    std::vector<CastRay> rays;
    std::vector<RayColumn> columns;
    /// [whole_columns, Sampling::rays]: not 0 where edge strips leave the column its middle strip.
    std::vector<std::uint8_t> narrowed;
    std::size_t whole_columns = 0;
    std::uint64_t dropped = 0;  ///< as in Samples
};

/// Casts rays along every column of the view. Where neighbouring columns disagree, edge strips are
/// cast as well; the gap between two neighbouring rays is split for as long as its estimate is too
/// uncertain.
RayColumns cast_ray_columns(const Caster& caster, const View& view, const LocalPose& pose,
                            const Sampling& sampling);

}  // namespace sonarsim
