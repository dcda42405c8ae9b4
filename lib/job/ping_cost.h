#pragma once

#include <vector>

#include "dataset/writers.h"

namespace sonarsim {

/// Mean cost of a ping of a sonar.
struct PingCost {
    double seconds = 0.0;  ///< on one thread, without the disk
    double bytes = 0.0;    ///< size of its files and records
};

/// Renders a few pings of each sonar as the mission would, with its engine and its writers, and
/// keeps nothing of them. By Mission::sensors. Adds to `set_up_s` the time to make the engine, and
/// the time by which the first ping of each sonar is longer than the others: it fills tables.
std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const std::vector<Writers>& writers, double& set_up_s);

}  // namespace sonarsim
