#pragma once

#include <string_view>
#include <vector>

#include "checks/warning.h"
#include "ping/sonar.h"

namespace sonarsim {

/// The memory of one ping of a sonar, about.
struct PingMemory {
    double bytes = 0.0;
    std::string_view key;  ///< of the sensor's section, that would bring it down the most
};
PingMemory ping_memory(const Sonar& sonar);

/// W26 for every sonar of which `threads` pings at once take more than the `available` bytes.
std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available);

/// Whether one ping of any of the sonars takes more than the `available` bytes.
bool exceeds_memory(const std::vector<Sonar>& sonars, double available);

}  // namespace sonarsim
