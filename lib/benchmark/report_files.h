#pragma once

#include <string>

#include "benchmark/report.h"

namespace sonarsim {

/// The report as JSON: `rows` with one object per sonar and setting, `stages`, `reference`,
/// `growth`, `multipath_rows`, `label_rows`. Ends with a line feed.
std::string report_json(const Report& report);

/// The rows as CSV with a header; the summaries as columns *_min and *_max.
std::string report_csv(const Report& report);

/// The multipath rows as CSV with a header, the columns named as in the JSON.
std::string multipath_csv(const Report& report);

}  // namespace sonarsim
