#include "visibility/octree/search.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// Edge of an automatic leaf, in widths of a beam.
constexpr double beams_per_leaf = 1.4;
/// And at the least, in range bins: nearer than that, beams tell more apart than bins can show.
constexpr double least_bins_per_leaf = 0.5;
/// In range bins, where beams are as wide as the view.
constexpr double bins_per_leaf = 1.5;
/// However wide the bins are.
constexpr double leaves_per_range = 64.0;

}  // namespace

Field::Field(const View& view, const Pose& T_local_sensor, double leaf_m)
    : R_sensor_local_(T_local_sensor.rotation.toRotationMatrix().transpose().cast<float>()),
      position_(T_local_sensor.translation),
      reach_(static_cast<float>(view.range_max_m)),
      fixed_leaf_(static_cast<float>(leaf_m)),
      leaf_per_m_(0.0F),
      least_leaf_(static_cast<float>(bins_per_leaf * view.bin_m())) {
    if (view.shape == ViewShape::fan) {
        leaf_per_m_ = static_cast<float>(beams_per_leaf * view.azimuth_rad / view.beams);
        least_leaf_ = static_cast<float>(least_bins_per_leaf * view.bin_m());
    }
    least_leaf_ = std::min(least_leaf_, static_cast<float>(view.range_max_m / leaves_per_range));
    const SinCos azimuth = sincos(0.5 * view.azimuth_rad);
    const SinCos elevation = sincos(0.5 * view.elevation_rad);
    sin_azimuth_ = static_cast<float>(azimuth.sin);
    cos_azimuth_ = static_cast<float>(azimuth.cos);
    sin_elevation_ = static_cast<float>(elevation.sin);
    cos_elevation_ = static_cast<float>(elevation.cos);
}

Side Field::side(const Eigen::Vector3f& centre, float radius) const {
    const Eigen::Vector3f p = R_sensor_local_ * centre;
    const float beyond = p.norm() - reach_;
    // Distances from the half plane of the outermost azimuth and from the cone of the outermost
    // elevation, positive outside, both folded to one side by symmetry.
    const float aside = std::fabs(p.y()) * cos_azimuth_ - p.x() * sin_azimuth_;
    const float rho = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const float above = std::fabs(p.z()) * cos_elevation_ - rho * sin_elevation_;
    const float out = std::max({beyond, aside, above});
    if (out > radius) return Side::outside;
    return out < -radius ? Side::inside : Side::across;
}

float Field::leaf_m(float distance) const {
    return fixed_leaf_ > 0.0F ? fixed_leaf_ : std::max(leaf_per_m_ * distance, least_leaf_);
}

}  // namespace sonarsim
