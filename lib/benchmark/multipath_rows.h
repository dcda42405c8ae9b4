#pragma once

#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// The ways to find multipath that a report compares: exact, and clusters for epsilon in
/// {1, 3, 5, 9} bins and delta in {5, 15, 30} degrees. `own` is among them.
std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own);

/// Measures every sonar that has multipath by every one of its multipath_settings(), with the
/// engine and the goal of the mission, on poses spread along the trajectory. The ways take turns.
std::vector<MultipathRow> measure_multipath(const Mission& mission, const Assembly& assembly,
                                            const ReportOptions& options,
                                            const ReportProgress& progress);

}  // namespace sonarsim
