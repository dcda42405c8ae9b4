#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "assembly/assemble.h"
#include "checks/survey.h"
#include "checks/warning.h"
#include "dataset/sensor_summary.h"

namespace sonarsim {

/// All warnings about a valid mission. `sonars` are by Mission::sensors; `rays` casts into the
/// scene.
std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays);

/// The warnings that need no ping: what reading the scene found, water, materials, angles and
/// heights of the mission, engine and fans.
std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly);

/// W01: the findings of reading the scene.
std::vector<Warning> reading_warnings(const Scene& scene);

/// Warnings about the size of the scene, its upward axis, and parts that it has twice.
std::vector<Warning> scene_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars);

/// Water and materials with values that no real water or solid has.
std::vector<Warning> material_warnings(const WaterConfig& water, const Scene& scene);

/// Values of the mission that hardly fit the rest of it: angles of sonars and objects that look
/// like radians, unused heights, a depth far from the vehicle's.
std::vector<Warning> mission_warnings(const Mission& mission, const Trajectory& trajectory);

/// Attitudes: angles that look like radians, quaternions that look like w, x, y, z.
std::vector<Warning> trajectory_warnings(const TrajectoryConfig& config,
                                         const Trajectory& trajectory);

/// Warnings about a sonar in a survey: blind pings and the reasons, echoes below the noise,
/// pictures that are white or black.
std::vector<Warning> sonar_warnings(const OutputConfig& output, const Sonar& sonar,
                                    double full_scale, const SonarSurvey& found);

/// Images of a run that are black, nearly black or white, or less accurate than the goal. `sensors`
/// are by Mission::sensors; one without pings has no warnings.
std::vector<Warning> image_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SensorSummary> sensors);

/// Objects that the mission places or gives a class, and that no sonar sees. An object that the
/// survey did not see is looked for in pings that have it in view.
std::vector<Warning> unseen_objects(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars,
                                    const VisibilityEngine& rays);

/// W36: groups of scene.particles of which no sonar sees a target.
std::vector<Warning> unseen_particles(const Mission& mission, const Assembly& assembly,
                                      const VisibilityEngine& rays);

/// Adds to W04, W12 and W17 a question about the unit of files whose size is about three orders of
/// magnitude off the ranges of the sonars.
void ask_for_units(const Mission& mission, const Scene& scene, std::vector<Warning>& warnings);

/// An estimate of the memory of one ping of a sonar.
struct PingMemory {
    double bytes = 0.0;
    std::string_view key;  ///< the key of the sensor that would reduce the memory most
};
PingMemory ping_memory(const Sonar& sonar);

/// W26 for every sonar whose pings on `threads` threads take more than the `available` bytes.
std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available);

/// True if one ping of any of the sonars takes more than the `available` bytes.
bool exceeds_memory(const std::vector<Sonar>& sonars, double available);

/// W34 if a dataset of `bytes` does not fit into the `available` bytes.
std::vector<Warning> disk_warnings(const std::string& folder, double bytes, double available);

}  // namespace sonarsim
