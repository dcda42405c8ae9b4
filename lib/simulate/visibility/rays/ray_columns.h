#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/rays/bent_rays.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// A column of rays that disagrees with its neighbour is divided into a wide middle strip and two
/// narrow edge strips, each this share of the column's width: in a bin a sliver of surface is as
/// bright as a full view of it, so a silhouette within the column needs rays on both sides.
inline constexpr float edge_strip_share = 0.1F;

/// Rays extend beyond the greatest range by this share of it. Surface there has no echo in range
/// and hides no surface in range, but it shows whether the surface in range continues.
inline constexpr float overreach = 0.01F;

/// The sampling density of the rays engine for a view.
struct Sampling {
    int columns = 1;          ///< number of columns: per beam of a fan, per side, or around a cone
    int rays = 32;            ///< along a column before gaps are split, 2 at least
    float inset = 0.5F;       ///< steps from a column's ends to its first and last ray
    int split_levels = 8;     ///< the most splits of the gap between two neighbouring rays
    int bend_levels = 1;      ///< the fewest splits of a gap in which the surface bends
    bool edge_strips = true;  ///< columns that disagree with a neighbour get edge strips
    float range_uncertainty_m = 0.0F;  ///< gaps with more than this are split
    float tolerance_m = 0.0F;  ///< largest difference of a neighbour's plane from a ray's range
    float longest_m = std::numeric_limits<float>::max();  ///< greatest extent of a sample in range
    float tolerance_cosine = 0.1F;  ///< largest relative difference of a cosine between columns

    /// Spacing of the rays of a column that spans `span`, before gaps are split; same unit.
    double step(double span) const { return span / (rays - 1 + 2.0 * inset); }
};

/// The density that meets the view's error goal, fitted to the speed-against-error report.
Sampling sampling_for(const View& view);

/// A ray of a column and the plane of the facet that it met, in the sensor frame.
struct CastRay {
    static constexpr int none = -1;

    Eigen::Vector3f direction;
    float along;                                       ///< angle along the column, rad
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< distance of the sensor from the plane
    float cosine = 0.0F;                               ///< cosine of the angle of incidence
    float range_m = 0.0F;
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    int next = none;         ///< index of the next ray along the column
    bool continuous = true;  ///< the surface probably continues to the next ray
    float border = 0.5F;     ///< end of this ray's segment, as a share of the angle to the next

    bool missed() const { return facet == Caster::nothing; }
};

/// The surface between two neighbouring rays of a column, by the planes that they met.
struct GapEstimate {
    bool continuous = true;  ///< the surface continues between the rays
    float border = 0.5F;     ///< border of the two planes, as a share of the gap
    /// Extent in range, m, whose echo may differ from that of the two planes.
    float range_uncertainty_m = 0.0F;
    bool bends = false;  ///< the surface continues and bends by more than five degrees
};

/// The surface is continuous if the two planes are nearly one, or if they cross between the rays,
/// at an edge between two facets, which is found exactly. The range uncertainty is the extent in
/// range of the planes between the rays, weighted by the relative error of the cosine. If the
/// surface is interrupted, it is the whole extent that either plane could cover before the other
/// ray, up to `reach_m`, the greatest range of the view. The angle between the rays must be small.
GapEstimate estimate_gap(const CastRay& a, const CastRay& b, const Sampling& sampling,
                         float reach_m);

/// The angle along the column of the ray that splits a gap between two neighbours.
float split_angle(const CastRay& a, const CastRay& b, float reach_m);

/// True if adjacent rays of two columns met surfaces that are not one plane of one material.
bool disagree(const CastRay& a, const CastRay& b, const Sampling& sampling, float reach_m);

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
    /// [whole_columns, Sampling::rays]: nonzero if edge strips leave only the middle strip.
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
/// they end half way. Appends the samples of `beams` to those of the earlier beams.
void add_column_samples(const View& view, const Sampling& sampling, const RayColumns& columns,
                        BeamRange beams, Samples& samples);

}  // namespace sonarsim
