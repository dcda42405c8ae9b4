#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A point target in the water.
struct Particle {
    Eigen::Vector3d start_m;  ///< place at time 0, world
    Eigen::Vector3d velocity_m_s;
    /// Its height wraps between these, if the second is greater: a bubble at the top starts again
    /// at the bottom.
    double bottom_m = 0.0, top_m = 0.0;
    float section_m2 = 0.0F;     ///< backscattering cross-section: 10 log of it is the strength
    std::uint32_t material = 0;  ///< index into Scene::materials
    std::uint32_t instance = 0;  ///< index into Scene::instances
};

/// The point targets of a scene, with their strengths at the frequency of one sonar.
struct Particles {
    std::vector<Particle> all;
    std::vector<double> time_s;  ///< since the first ping, by pose of the trajectory
};

/// The place of a particle, world.
Eigen::Vector3d place_at(const Particle& particle, double time_s);

/// Adds the particles in view that no surface hides. One ray tests each. Their samples are points:
/// without edges, with the cross-section as their area, facing the sonar.
void add_particles(const Particles& particles, double time_s, const View& view,
                   const VisibilityEngine& engine, const Pose& T_world_sensor,
                   const PingMotion& motion, Samples& samples);

}  // namespace sonarsim
