#include "preview/beams.h"

#include <algorithm>

#include "core/units.h"
#include "visibility/angles.h"

namespace sonarsim {

namespace {

constexpr int edge_steps = 48;  // rays along each side, or around a cone

Ray ray_along(const Eigen::Vector3d& direction) {
    return {Eigen::Vector3f::Zero(), direction.cast<float>().normalized()};
}

std::vector<Ray> rays_around(const View& view) {
    std::vector<Ray> rays;
    const double azimuth = 0.5 * view.azimuth_rad;
    const double elevation = 0.5 * view.elevation_rad;
    if (view.shape == ViewShape::cone) {
        for (int k = 0; k < edge_steps; ++k)
            rays.push_back(ray_along(direction_off_boresight(azimuth, 2.0 * pi * k / edge_steps)));
        return rays;
    }
    for (int k = 0; k <= edge_steps; ++k)
        rays.push_back(ray_along(direction_of(azimuth * (2.0 * k / edge_steps - 1.0), elevation)));
    for (int k = edge_steps; k >= 0; --k)
        rays.push_back(ray_along(direction_of(azimuth * (2.0 * k / edge_steps - 1.0), -elevation)));
    return rays;
}

}  // namespace

BeamOutline beam_outline(const Sonar& sonar, const VisibilityEngine& engine,
                         const Pose& T_world_sensor, Rgb colour) {
    const View& view = sonar.settings.view;
    const std::vector<Ray> rays = rays_around(view);
    std::vector<Intersection> met(rays.size());
    engine.intersect(T_world_sensor, rays, met);
    BeamOutline outline{T_world_sensor.translation, {}, colour};
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const double range = std::min<double>(met[k].distance_m, view.range_max_m);
        outline.ends.push_back(T_world_sensor.translation +
                               T_world_sensor.rotation *
                                   (range * rays[k].direction.cast<double>()));
    }
    return outline;
}

}  // namespace sonarsim
