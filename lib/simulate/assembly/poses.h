#pragma once

#include "input/mission/mission.h"
#include "input/scene/objects.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/scene.h"
#include "input/trajectory/trajectory.h"
#include "simulate/ping/sonar.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The poses of moving bodies at a time of their trajectories.
std::vector<Pose> poses_at(std::span<const Trajectory> motions, double t_s);

/// The engine for a ping at a time, with the scene's bodies then. It must not outlive `engine`.
std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s);

/// The poses of a trajectory. Throws InputError for errors in its file or numbers.
Trajectory poses_of(const TrajectoryConfig& config);
/// The same with the poses alone that the configuration gives: corners stay sharp.
Trajectory path_of(TrajectoryConfig config);

/// The poses of a mission's vehicle: its trajectory with the offset `vehicle`, whose numbers may be
/// drawn for every ping, and with the movements of `vehicle.motion`. With `look_at` only their
/// times and their number are right, until look_at_poses() gives `poses` for moved_vehicle().
Trajectory vehicle_poses(const Mission& mission);
Trajectory moved_vehicle(const Mission& mission, Trajectory poses);

/// The poses of `trajectory.look_at`, one second apart from 0 on. Each has an object at a drawn
/// distance and height, and at a drawn azimuth and elevation of the sensor that `mount`
/// (T_vehicle_sensor) places; null: at an azimuth from the bow of a level vehicle. The sensor lies
/// within the bounds of the scene, seen from above, and outside of the boxes of all objects that
/// are no background. Something may hide the object. Objects that move are left out. Where no
/// object of known classes was placed, a drawn place of the scene stands for one. InputError if
/// there is no such object or class, or no room for a pose.
Trajectory look_at_poses(const LookAtTrajectoryConfig& config, const Scene& scene,
                         const SceneObjects& objects, const Pose* mount, std::uint64_t seed);

/// Adds the height of the bottom and `altitude_m` of a lawnmower to poses. InputError without one.
void keep_altitude(const Mission& mission, const Bottom* bottom, Trajectory& poses);

/// The poses that the vehicle's navigation reports; empty if it reports the true ones.
Trajectory navigation_poses(const Mission& mission, const Trajectory& truth);

/// Sets the motions of the sonars with moves_in_ping at each pose, by the poses before and after
/// it. InputError if such a sonar has a setting that supports only a sonar at rest.
void add_ping_motions(const Mission& mission, const Trajectory& trajectory,
                      std::span<Sonar> sonars);

/// The poses of at most `most` pings of a sonar that pings at every `every`-th of `poses` poses:
/// the middles of equal parts of the whole trajectory, whichever part is rendered.
inline std::vector<std::uint32_t> sample_pings(std::size_t poses, int every,
                                               std::size_t max_count) {
    const auto step = static_cast<std::size_t>(every);
    const std::size_t pings = (poses + step - 1) / step;
    const std::size_t count = std::min(pings, max_count);
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < count; ++k)
        chosen.push_back(static_cast<std::uint32_t>((2 * k + 1) * pings / (2 * count) * step));
    return chosen;
}

/// altitude_m() as the sonar measures it by the time of sound, which differs where sound bends.
std::optional<double> measured_altitude_m(const Scene& scene, const VisibilityEngine& engine,
                                          const Pose& T_world_sensor);

}  // namespace sonarsim
