#pragma once

#include <vector>

#include "dataset/writers.h"

namespace sonarsim {

/// What a ping of a sonar costs, in the mean over a few.
struct PingCost {
    double seconds = 0.0;  ///< of one thread, without the disk
    double bytes = 0.0;    ///< of its files and records
};

/// Renders a few pings of each sonar as the mission would, with its engine and its writers, and
/// keeps nothing of them. By Mission::sensors. The seconds are as long as they took here and now.
std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const std::vector<Writers>& writers);

}  // namespace sonarsim
