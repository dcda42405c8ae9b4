#pragma once

#include <string>

#include "benchmark/report.h"

namespace sonarsim {

/// The report as tables for a terminal: costs and errors, stages and floors, per sonar what
/// `engine: auto` takes and why, and the multipath rows.
std::string report_text(const Report& report);

/// The same tables in Markdown, for documents: one row per setting, the front in bold.
std::string report_markdown(const Report& report);

/// Which engine `engine: auto` takes for a sonar, and by which figures. By the rule: of the
/// settings whose mean relative L1 meets the mission's goal, the fastest; if none meets it, the
/// most accurate.
std::string explain_auto(const Report& report, const std::string& sensor);

}  // namespace sonarsim
