#pragma once

#include <array>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "trace/multipath.h"

namespace sonarsim::test {

/// A fan of 128 beams and 512 bins from 0.5 to 10 m.
View fan(double azimuth_deg, double elevation_deg);

Multipath clusters_of(int epsilon, double delta_deg = 15.0);

struct Found {
    Samples samples;
    std::vector<BouncePath> bounces;
    MultipathCounts counts;
};

/// The multipath of one ping, with rays.
Found find(const Scene& scene, const View& view, const Multipath& multipath, const Pose& pose = {});

/// Poses in tank() that see much of it.
std::array<Pose, 3> tank_poses();

}  // namespace sonarsim::test
