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
    /// Power falls as e^-(loss r) for a way r in the sediment, out and back, besides what it loses
    /// in the water r / speed_ratio that stands for this way.
    double loss_per_m = 0.0;
};

/// The way of sound from a sonar to a place below a flat bottom.
struct WayIntoBottom {
    double angle_rad;  ///< to the normal, in the water
    double in_water_m;
    double in_sediment_m;
    /// Spreading: a solid angle of 1 sr at the sonar has this area at the place, m^2, across the
    /// way.
    double spread_m2;
    double transmitted;  ///< share of the power that passes the surface, one way

    /// Half of the two-way time, as a way in the water.
    double range_m(const SedimentPath& sediment) const {
        return in_water_m + in_sediment_m / sediment.speed_ratio;
    }
};

/// The refracted way to a place at a depth below a plane, from a height above it, `across_m` along
/// it.
WayIntoBottom way_into_bottom(const SedimentPath& sediment, double height_m, double depth_m,
                              double across_m);

/// The echo of a point of 1 m^2 at the end of that way by that of one in the water at its range:
/// with T the share that passes, n the ratio of speeds and L^2 the spread, T^2 n^2 r^4 / L^4 times
/// the loss. The way back spreads over L^2 / n^2, since solid angles in the sediment are wider by
/// n^2 cos / cos, and areas across the way in the water by the inverse of the cosines.
double echo_through_bottom(const SedimentPath& sediment, const WayIntoBottom& way);

/// The place at which the sonar sees a buried point: in the direction in which sound leaves for it,
/// at its two-way time, with its echo as its section. `hit`: what the straight line to it meets
/// first, which gives the plane of the bottom. `sediments`: by material. Nothing if that is no sea
/// bed above it.
std::optional<Sample> seen_buried(std::span<const SedimentPath> sediments, const Sample& point,
                                  const Intersection& hit);

/// The part of a buried object as the sonar sees it: at such a place, and turned so that its normal
/// has the angle to the sight line that it has to the sound in the sediment. Nothing, too, if it
/// faces away from that. `hit`: what a ray from the sonar near the part meets first.
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
