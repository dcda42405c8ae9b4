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

/// The way of sound below the surface of a sea bed.
struct SedimentPath {
    double speed_ratio = 0.0;  ///< speed of sound to that of the water; 0: no sea bed
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

/// The refracted path from a height above a plane to a depth below it, `across_m` apart along it.
WayIntoBottom way_into_bottom(const SedimentPath& sediment, double height_m, double depth_m,
                              double across_m);

/// The echo of a point of 1 m^2 at the end of that path over the echo of one in the water at its
/// range: T^2 n^2 r^4 / L^4 times the loss, with T the transmitted share, n the ratio of speeds and
/// L^2 the spread. The way back spreads over L^2 / n^2, since solid angles in the sediment are
/// wider by n^2 cos / cos, and areas across the way in the water by the inverse of the cosines.
double echo_through_bottom(const SedimentPath& sediment, const WayIntoBottom& way);

/// The apparent place of a buried point: in the direction of departure, at the range of its two-way
/// time, with its echo as its section. `hit`: the first hit of the straight line to it, which gives
/// the plane of the bottom. `sediments`: by material. Nothing unless it lies below a sea bed.
std::optional<Sample> seen_buried(std::span<const SedimentPath> sediments, const Sample& point,
                                  const Intersection& hit);

/// The same for a part of a buried object. It is turned so that its normal makes the same angle
/// with the sight line as with the sound in the sediment. Nothing, too, if it faces away from that
/// sound. `hit`: the first hit of a ray from the sonar near the part.
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
