#pragma once

#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// The multipath methods that a report compares: exact, and clusters for epsilon in {1, 3, 5, 9}
/// bins and delta in {5, 15, 30} degrees; and `own`.
std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own);

/// Measures every sonar that has multipath with each of its multipath_settings(), with the engine
/// and the error goal of the mission, on poses sampled along the trajectory. The methods take
/// turns.
std::vector<MultipathRow> measure_multipath(const Mission& mission, const Assembly& assembly,
                                            const ReportOptions& options,
                                            const ReportProgress& progress);

}  // namespace sonarsim
