#pragma once

#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// Measures every sonar with each kind of label alone and with all of them, with the engine and the
/// error goal of the mission, on poses sampled along the trajectory. `height` is omitted for a
/// mission without scene.bottom. The kinds take turns. Masks, boxes and files are not included.
/// Empty for a mission without labels.
std::vector<LabelRow> measure_labels(const Mission& mission, const Assembly& assembly,
                                     const ReportOptions& options, const ReportProgress& progress);

}  // namespace sonarsim
