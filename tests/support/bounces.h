#pragma once

#include "simulate/trace/multipath.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/test.h"

namespace sonarsim::test {

/// A fan of 128 beams and 512 bins from 0.5 to 10 m.
inline View fan(double azimuth_deg, double elevation_deg) {
    return {radians(azimuth_deg), radians(elevation_deg), 0.5, 10.0, 512, 128, 0.03};
}

inline Multipath clusters_of(int epsilon, double delta_deg = 15.0) {
    return {.on = true,
            .cluster = {.epsilon_bins = epsilon,
                        .delta_cosine = static_cast<float>(std::cos(radians(delta_deg)))}};
}

struct Found {
    Samples samples;
    std::vector<BouncePath> bounces;
    MultipathCounts counts;
};

/// The multipath of one ping, with rays.
inline Found find(const Scene& scene, const View& view, const Multipath& multipath,
                  const Pose& pose = {}) {
    const auto engine = make_rays_engine(scene);
    Found found;
    found.samples = engine->visible_surface(view, pose);
    found.bounces = find_bounces(
        multipath, {.view = view, .scene = scene, .engine = *engine, .T_world_sensor = pose},
        found.samples, found.counts);
    return found;
}

/// Poses in tank() that see much of it.
inline std::array<Pose, 3> tank_poses() {
    return {Pose{rotation_from_rpy(0.0, radians(5.0), radians(20.0)), {-3.0, -1.0, 1.5}},
            Pose{rotation_from_rpy(0.0, radians(10.0), radians(8.0)), {-2.7, -0.3, 1.5}},
            Pose{rotation_from_rpy(0.0, radians(20.0), radians(-16.0)), {-2.1, 1.1, 1.5}}};
}

}  // namespace sonarsim::test
