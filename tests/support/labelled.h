#pragma once

#include "simulate/labels/labels.h"
#include "simulate/visibility/view.h"
#include "support/sonars.h"

namespace sonarsim::test {

inline constexpr std::array engine_types{EngineKind::rays, EngineKind::strips};
inline const ObjectSphere anywhere{Eigen::Vector3d::Zero(), 30.0};
inline const LabelRequest everything{.objects = true,
                                     .shares = true,
                                     .classes = true,
                                     .materials = true,
                                     .elevation = true,
                                     .shadow = true,
                                     .annotated = {&anywhere, 1}};

/// The objects of a scene, of which the first is a floor and background.
inline SceneObjects objects_on_floor(const Scene& scene) {
    SceneObjects objects = group_objects(scene, {});
    objects.background.assign(objects.classes.size(), 0);
    objects.background[0] = 1;
    return objects;
}

/// A scene, its labels and the image without noise.
struct Labelled {
    SceneObjects objects;
    TracedPing traced;
    PingLabels labels;
    Ping clean;

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * labels.range_bins + i;
    }
};

inline Labelled label(const Scene& scene, const Sonar& sonar, const Pose& pose, EngineKind type,
                      const LabelRequest& request = everything,
                      const std::optional<SceneObjects>& objects = {}) {
    const auto engine = engine_of(scene, type);
    Labelled out{objects ? *objects : group_objects(scene, {}),
                 trace(sonar, scene, *engine, pose, 0),
                 {},
                 {}};
    out.labels = label_ping(out.traced, sonar.settings, scene, out.objects, *engine, request);
    out.clean = form_image(out.traced, sonar.settings, scene, {}, without_random_terms);
    return out;
}

/// Rays that cover a view: `across` columns to a beam, evenly spread over either side.
struct RayGrid {
    int across, up;
};

/// Follows the rays through all that they meet, or `layers` of it. Calls visit(bin, elevation,
/// layer, range, met) for what is in range, the bin in [beams, range bins].
template <class Visit>
void follow_rays(const Scene& scene, const Sonar& sonar, const Pose& pose, const RayGrid& grid,
                 int layers, Visit visit) {
    constexpr float step = 1e-5F;
    const View& view = sonar.settings.view;
    const auto engine = make_engine(scene, {});
    std::vector<Ray> rays(grid.up);
    std::vector<Intersection> met(grid.up);
    const int columns = view.beams * grid.across;
    for (int n = 0; n < columns; ++n) {
        const double azimuth = ((n + 0.5) / columns - 0.5) * view.azimuth_rad;
        const auto elevation_of = [&](int k) {
            return ((k + 0.5) / grid.up - 0.5) * view.elevation_rad;
        };
        for (int k = 0; k < grid.up; ++k) {
            const Eigen::Vector3d to = direction_of(azimuth, elevation_of(k));
            rays[k] = {Eigen::Vector3f::Zero(), to.cast<float>()};
        }
        for (int layer = 0; layer < layers; ++layer) {
            engine->intersect(pose * sonar.T_vehicle_sensor, rays, met);
            for (int k = 0; k < grid.up; ++k) {
                const float range = rays[k].origin.norm() + met[k].distance_m;
                // A ray that has left the scene starts so far away that it meets nothing.
                rays[k].origin = rays[k].direction * std::min(range * (1.0F + step), 1e6F);
                if (!(range >= view.range_min_m && range < view.range_max_m)) continue;
                visit(static_cast<std::size_t>(n / grid.across) * view.range_bins +
                          static_cast<std::size_t>(bin_at(sonar, range)),
                      elevation_of(k), layer, static_cast<double>(range), met[k]);
            }
        }
    }
}

}  // namespace sonarsim::test
