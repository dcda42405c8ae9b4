#include "simulate/visibility/view_volume.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

ViewVolume::ViewVolume(const View& view, const Pose& T_local_sensor)
    : R_sensor_local_(T_local_sensor.rotation.toRotationMatrix().transpose().cast<float>()),
      position_(T_local_sensor.translation),
      reach_m_(static_cast<float>(view.range_max_m)) {
    const SinCos azimuth = sincos(0.5 * view.azimuth_rad);
    const SinCos elevation = sincos(0.5 * view.elevation_rad);
    sin_azimuth_ = static_cast<float>(azimuth.sin);
    cos_azimuth_ = static_cast<float>(azimuth.cos);
    sin_elevation_ = static_cast<float>(elevation.sin);
    cos_elevation_ = static_cast<float>(elevation.cos);
}

Containment ViewVolume::of_sensor_frame(const Eigen::Vector3f& p, float radius) const {
    const float beyond_reach = p.norm() - reach_m_;
    // Distances from the half plane of the outermost azimuth and from the cone of the outermost
    // elevation, positive outside; symmetry reduces both to one side.
    const float beyond_azimuth = std::fabs(p.y()) * cos_azimuth_ - p.x() * sin_azimuth_;
    const float rho = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const float beyond_elevation = std::fabs(p.z()) * cos_elevation_ - rho * sin_elevation_;
    const float beyond = std::max({beyond_reach, beyond_azimuth, beyond_elevation});
    if (beyond > radius) return Containment::outside;
    return beyond < -radius ? Containment::inside : Containment::partly;
}

}  // namespace sonarsim
