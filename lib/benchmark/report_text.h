#pragma once

#include <string>

#include "benchmark/report.h"

namespace sonarsim {

/// The report as tables for a terminal: costs and errors, stages and lower bounds, the choice of
/// `engine: auto` per sonar with its reason, the multipath rows and the label rows.
std::string report_text(const Report& report);

/// The same tables in Markdown, for documents: one row per setting, the Pareto front in bold.
std::string report_markdown(const Report& report);

/// Explains which engine `engine: auto` takes for a sonar: the fastest of the settings whose mean
/// relative L1 meets the mission's goal; if none meets it, the most accurate.
std::string explain_auto(const Report& report, const std::string& sensor);

}  // namespace sonarsim
