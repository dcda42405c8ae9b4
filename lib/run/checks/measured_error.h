#pragma once

#include <optional>
#include <span>
#include <vector>

#include "input/mission/mission.h"
#include "output/dataset/json.h"
#include "run/checks/warning.h"
#include "simulate/assembly/assemble.h"
#include "simulate/reference/reference.h"

namespace sonarsim {

/// The error of one ping's image, as error_without_noise() estimates it. Where the noise of the
/// reference is above half of both the error and the goal, it is the change to a finer goal.
struct PingError {
    std::uint32_t pose = 0;
    /// Nothing where neither the reference nor a finer image tells it, or nothing is in view.
    std::optional<double> relative_l1;
    double noise = 0.0;  ///< the noise of the reference, which does not enter `relative_l1`
    bool by_finer_image = false;  ///< the change to a finer goal, for want of a better reference
};

/// The error of a sonar at a few pings that are spread over its trajectory.
struct MeasuredError {
    std::vector<PingError> pings;

    std::optional<double> mean() const;      ///< over the pings with a relative L1
    std::optional<PingError> worst() const;  ///< the largest error of these
    /// The least error that could be measured in all pings; 0 where each has one.
    double min_measurable() const;
};

/// Casts the reference of a sonar's direct echoes of surface, for either echo model.
Reference cast_reference(const Caster& caster, const Scene& scene, const Sonar& sonar,
                         const Pose& T_world_sensor, ReferenceGoal goal);

/// The image of the direct echoes of surface from a pose where sonar and objects stand still.
Ping direct_image(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                  const Pose& T_world_sensor);

/// Measures the error of each sonar with the mission's engine at up to three pings, with a bounded
/// number of rays; it depends on the mission alone. Nothing where sound bends, which the
/// reference's rays do not. Uses all threads of the arena.
std::vector<std::optional<MeasuredError>> measure_errors(const Mission& mission,
                                                         const Assembly& assembly,
                                                         const VisibilityEngine& engine);

/// For dataset.json: mean, worst, and every ping with the noise of its reference; null: none.
Json json_of(const std::optional<MeasuredError>& error);

/// A warning for each sonar with a measured error above the mission's goal, with the key to change.
std::vector<Warning> error_warnings(const Mission& mission,
                                    std::span<const std::optional<MeasuredError>> errors);

}  // namespace sonarsim
