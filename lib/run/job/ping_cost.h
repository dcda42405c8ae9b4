#pragma once

#include <vector>

#include "output/dataset/layout.h"

namespace sonarsim {

/// Mean cost of a ping of a sonar.
struct PingCost {
    double seconds = 0.0;  ///< on one thread, without the disk
    double bytes = 0.0;    ///< its files and records, and its share of what all pings make
};

/// The costs by Mission::sensors: renders a few pings with the mission's engine and writers. Adds
/// to `set_up_s` the time to make the engine and the extra time of each first ping (tables).
std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const Layout& layout, double& set_up_s);

}  // namespace sonarsim
