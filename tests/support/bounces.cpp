#include "support/bounces.h"

#include <cmath>

#include "core/units.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim::test {

View fan(double azimuth_deg, double elevation_deg) {
    return {.azimuth_rad = radians(azimuth_deg),
            .elevation_rad = radians(elevation_deg),
            .range_min_m = 0.5,
            .range_max_m = 10.0,
            .range_bins = 512,
            .beams = 128,
            .relative_l1 = 0.03};
}

Multipath clusters_of(int epsilon, double delta_deg) {
    return {.on = true,
            .cluster = {.epsilon_bins = epsilon,
                        .delta_cosine = static_cast<float>(std::cos(radians(delta_deg)))}};
}

Found find(const Scene& scene, const View& view, const Multipath& multipath, const Pose& pose) {
    const auto engine = make_rays_engine(scene);
    Found found;
    found.samples = engine->visible_surface(view, pose);
    found.bounces = find_bounces(
        multipath, {.view = view, .scene = scene, .engine = *engine, .T_world_sensor = pose},
        found.samples, found.counts);
    return found;
}

std::array<Pose, 3> tank_poses() {
    return {Pose{rotation_from_rpy(0.0, radians(5.0), radians(20.0)), {-3.0, -1.0, 1.5}},
            Pose{rotation_from_rpy(0.0, radians(10.0), radians(8.0)), {-2.7, -0.3, 1.5}},
            Pose{rotation_from_rpy(0.0, radians(20.0), radians(-16.0)), {-2.1, 1.1, 1.5}}};
}

}  // namespace sonarsim::test
