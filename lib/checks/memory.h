#pragma once

#include <string_view>
#include <vector>

#include "checks/warning.h"
#include "ping/sonar.h"

namespace sonarsim {

/// An estimate of the memory of one ping of a sonar.
struct PingMemory {
    double bytes = 0.0;
    std::string_view key;  ///< the key of the sensor that would reduce it most
};
PingMemory ping_memory(const Sonar& sonar);

/// W26 for every sonar whose pings on `threads` threads take more than the `available` bytes.
std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available);

/// True if one ping of any of the sonars takes more than the `available` bytes.
bool exceeds_memory(const std::vector<Sonar>& sonars, double available);

}  // namespace sonarsim
