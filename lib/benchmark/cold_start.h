#pragma once

#include <span>
#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// Runs each setting with each sonar (sonars within settings) in a child process: builds the engine
/// and pings once at every pose of the report, on one thread. Peak memory can be measured only per
/// process. `assembled_s` is the time that reading the mission took; it counts towards the first
/// ping. Call this before the process starts any thread, since fork() copies only the calling
/// thread. Throws std::system_error when a child cannot be started, and std::runtime_error when one
/// fails.
std::vector<ColdStart> measure_cold_starts(const Mission& mission, const Assembly& assembly,
                                           std::span<const Setting> settings,
                                           const ReportOptions& options, double assembled_s);

}  // namespace sonarsim
