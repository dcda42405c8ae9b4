#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "input/mission/mission.h"
#include "run/checks/warning.h"
#include "simulate/assembly/assemble.h"
#include "simulate/reference/reference.h"

namespace sonarsim {

/// The error of one ping's image against the reference.
struct PingError {
    std::uint32_t pose = 0;
    double relative_l1 = 0.0;
    double noise = 0.0;  ///< noise of the reference, a part of `relative_l1`

    /// The least error that the reference's noise leaves to the image.
    double without_noise() const { return relative_l1 - noise; }
};

/// The error of a sonar at a few pings that are spread over its trajectory.
struct MeasuredError {
    std::vector<PingError> pings;

    double mean() const;
    const PingError& worst() const;
};

/// The mission without what a reference does not find: echoes of the water, and several samples per
/// range bin, which do not add up.
Mission without_water_echoes(Mission mission);

/// Casts the reference of a sonar's direct echoes, for either echo model. `sonar` is one of a
/// mission without_water_echoes().
Reference cast_reference(const Caster& caster, const Scene& scene, const Sonar& sonar,
                         const Pose& T_world_sensor, ReferenceGoal goal);

/// The image of the sonar's direct echoes from a pose where sonar and objects stand still.
Ping direct_image(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                  const Pose& T_world_sensor);

/// Measures the error of each sonar of a mission with its engine, by sonar, at up to three pings
/// with a bounded number of rays: about half a second each. It depends on the mission alone, not on
/// threads or on the part that is rendered. Nothing where sound bends, which the reference's rays
/// do not. Uses all threads of the arena.
std::vector<std::optional<MeasuredError>> measure_errors(const Mission& mission,
                                                         const Assembly& assembly,
                                                         const VisibilityEngine& engine);

/// For dataset.json: the mean, the worst and every ping with the noise of its reference.
nlohmann::ordered_json json_of(const MeasuredError& error);

/// A warning for each sonar that misses the mission's goal by more than the reference's noise, with
/// the key to change.
std::vector<Warning> error_warnings(const Mission& mission,
                                    std::span<const std::optional<MeasuredError>> errors);

}  // namespace sonarsim
