#pragma once

#include <limits>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/trace/sample_source.h"

namespace sonarsim {

/// The water's surface in the sensor's frame. The path of reflected sound is straight in the
/// world's mirror image, in which the sonar is at `image`.
struct WaterMirror {
    Eigen::Vector3f up;  ///< unit
    float height_m;      ///< height of the surface above the sonar
    float reflection;
    Eigen::Vector3f image;

    Eigen::Vector3f reflect_direction(const Eigen::Vector3f& direction) const {
        return direction - 2.0F * up.dot(direction) * up;
    }
    Eigen::Vector3f reflect_point(const Eigen::Vector3f& p) const {
        return reflect_direction(p) + image;
    }
    /// Distance of the surface along a ray from below; infinite if the ray does not rise.
    float distance(const Ray& ray) const {
        const float rise = up.dot(ray.direction);
        const float below = height_m - up.dot(ray.origin);
        return rise > 0.0F && below > 0.0F ? below / rise : std::numeric_limits<float>::infinity();
    }
};

/// A sonar in a hull is at the surface to within rounding, and counts as this far below it.
inline constexpr double just_below_m = 1e-6;

/// The water's surface in the sensor's frame; nothing for a sonar above it.
inline std::optional<WaterMirror> mirror_of(const std::optional<WaterSurface>& surface,
                                            const Pose& T_world_sensor) {
    if (!surface) return std::nullopt;
    const double height_m = surface->height_m - T_world_sensor.translation.z();
    if (!(height_m >= -just_below_m)) return std::nullopt;
    const Eigen::Vector3f up =
        (T_world_sensor.rotation.conjugate() * Eigen::Vector3d::UnitZ()).cast<float>();
    const auto height = static_cast<float>(std::max(height_m, just_below_m));
    return WaterMirror{up, height, surface->reflection, 2.0F * height * up};
}

/// Cuts off what lies above the water's surface, where sound from below does not arrive.
void cut_above_water(const Scene& scene, const Pose& T_world_sensor, Samples& samples);

/// The water's surface that scatters, as a sonar below it sees it: in its view, and for a side-scan
/// sonar all around the track, since its beam patterns reach upwards as well. The material of the
/// samples is the one after those of the scene; they have no instance. One ray decides on each.
class ScatteringSurface final : public SampleSource {
  public:
    void add(const TraceContext& context, const PingMotion& motion, std::uint32_t pose,
             Samples& samples) const override;
};

}  // namespace sonarsim
