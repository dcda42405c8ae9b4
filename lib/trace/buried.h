#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trace/target_facet.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The propagation of sound in the sediment of a sea bed.
struct SedimentPath {
    double speed_ratio = 0.0;  ///< ratio of the speed of sound to the water's; 0: no sea bed
    double density_ratio = 0.0;
    /// Two-way power falls as e^-(loss r) over a path r in the sediment, in addition to the
    /// absorption of the water path r / speed_ratio of equal time.
    double loss_per_m = 0.0;
};

/// The way of sound from a sonar to a place below a flat bottom.
struct WayIntoBottom {
    double angle_rad;  ///< to the normal, in the water
    double in_water_m;
    double in_sediment_m;
    /// Spreading: the area of a ray tube of 1 sr at the place, m^2, across the path.
    double spread_m2;
    double transmitted;  ///< share of the power that passes the surface, one way

    /// Half of the two-way time times the speed of sound in water.
    double range_m(const SedimentPath& sediment) const {
        return in_water_m + in_sediment_m / sediment.speed_ratio;
    }
};

/// The refracted path from a height above a plane to a depth below it. Its ends are `across_m`
/// apart along the plane.
WayIntoBottom way_into_bottom(const SedimentPath& sediment, double height_m, double depth_m,
                              double across_m);

/// The echo of a point of 1 m^2 at the end of a path, divided by its echo at the same range r in
/// the water: T^2 n^2 r^4 / L^4 times the loss, with T the transmitted share, n the ratio of speeds
/// and L^2 the spread. The spread of the way back is L^2 / n^2: refraction widens solid angles in
/// the sediment by n^2 cos / cos, and areas across the path in the water by the inverse ratio of
/// the cosines.
double echo_through_bottom(const SedimentPath& sediment, const WayIntoBottom& way);

/// The factor by which the distance of a buried place exceeds its apparent range at most; at least
/// 1, and above 1 where sound is faster in the sediment than in the water.
double most_distance_by_range(std::span<const SedimentPath> sediments);

/// The apparent place of a buried point: in the direction of departure, at the range of its two-way
/// time. Its area is scaled by echo_through_bottom(). `hit`: the first hit of the straight line to
/// the point; it gives the plane of the bottom. `sediments`: by material. Nothing unless the point
/// lies below a sea bed.
std::optional<Sample> seen_buried(std::span<const SedimentPath> sediments, const Sample& point,
                                  const Intersection& hit);

/// The same for a part of a buried object. The part is turned so that its normal makes the same
/// angle with the sight line as before with the sound in the sediment. Nothing, too, if the part
/// faces away from the sound. `hit`: the first hit of a ray from the sonar near the part.
std::optional<TargetFacet> seen_buried(std::span<const SedimentPath> sediments,
                                       const TargetFacet& part, const Ray& ray,
                                       const Intersection& hit);

/// The objects of a scene that sound reaches through the bottom.
struct BuriedObjects {
    std::vector<std::uint32_t> instances;  ///< ascending
    std::vector<SedimentPath> sediments;   ///< one for each of Scene::materials

    bool has(std::uint32_t instance) const {
        return std::ranges::binary_search(instances, instance);
    }
};

}  // namespace sonarsim
