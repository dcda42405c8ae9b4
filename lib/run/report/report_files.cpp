#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "run/report/report.h"

namespace sonarsim {

namespace {

/// Three significant digits, without an exponent.
std::string short_number(double x) {
    if (!(x >= 5e-5)) return "0";
    const int digits = 2 - static_cast<int>(std::floor(std::log10(x)));
    return fmt::format("{:.{}f}", x, std::clamp(digits, 0, 4));
}

double number(const Json& value) {
    return value.get<double>();
}

/// A column of a table: a key of the rows and its title. Titles that end in % are for shares.
struct Column {
    const char* key;
    std::string title;
};

std::string cell_of(const Json& row, const Column& column) {
    const Json& value = row[column.key];
    if (value.is_string()) return value;
    const bool share = column.title.ends_with('%');
    const std::string text = short_number((share ? 100.0 : 1.0) * number(value));
    const bool best = row.value("on_front", false) &&
                      (column.title == "ms per ping" || column.title == "relative L1, %");
    return best ? "**" + text + "**" : text;
}

/// The rows of a sonar as a Markdown table; empty for no rows.
std::string table(const Json& rows, const Json& sensor, const std::vector<Column>& columns) {
    std::string head = "\n|";
    std::string line = "|";
    for (const Column& column : columns) {
        head += " " + column.title + " |";
        line += "---|";
    }
    std::string text;
    for (const Json& row : rows) {
        if (row["sensor"] != sensor) continue;
        text += "|";
        for (const Column& column : columns)
            text += " " + cell_of(row, column) + " |";
        text += row.value("current", false) ? " the mission's own\n" : "\n";
    }
    return text.empty() ? "" : head + "\n" + line + "\n" + text;
}

}  // namespace

std::string report_json(const Json& report) {
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_markdown(const Json& report) {
    const auto count = [](const Json& value) { return value.get<std::uint64_t>(); };
    std::string text = fmt::format("{}: {} triangles, {} poses, {} threads\n",
                                   report["mission"].get<std::string>(), count(report["triangles"]),
                                   count(report["poses"]), count(report["threads"]));
    const double load = number(report["load"]);
    if (load > 0.5)
        text += fmt::format("The machine was busy (load {:.1f}): times are too long.\n", load);
    for (const Json& reference : report["reference"]) {
        const Json& sensor = reference["sensor"];
        text += fmt::format("\n{}: the noise of the reference is {} %, at most {} %.\n",
                            sensor.get<std::string>(),
                            short_number(100.0 * number(reference["noise_mean"])),
                            short_number(100.0 * number(reference["noise_max"])));
        text += table(report["rows"], sensor,
                      {{"engine", "engine"},
                       {"setting", "setting"},
                       {"ms_per_ping", "ms per ping"},
                       {"times_131k_rays", "x 131k rays"},
                       {"pings_per_s", "pings/s"},
                       {"relative_l1", "relative L1, %"},
                       {"worst_relative_l1", "worst pose, %"},
                       {"goal", "goal"},
                       {"miss_rate", "missed bins, %"},
                       {"samples_per_ping", "samples"}});
        text += table(report["multipath_rows"], sensor,
                      {{"method", "multipath"},
                       {"epsilon_bins", "epsilon"},
                       {"delta_deg", "delta"},
                       {"relative_l1", "its relative L1, %"},
                       {"recall", "recall, %"},
                       {"precision", "precision, %"},
                       {"ms_multipath", "ms"},
                       {"ms_per_ping", "ms per ping"},
                       {"times_without", "times the ping without"}});
    }
    const auto job = [&](const char* key) { return short_number(number(report["job"][key])); };
    text += fmt::format(
        "\nThe job makes {} images/s with labels and files on {} threads ({} images). On one "
        "thread an image takes: trace {} ms, form {} ms, facts {} ms, files {} ms; {} x 131k rays "
        "of the first sonar. Set-up: {} ms.\n",
        job("images_per_s"), count(report["threads"]), count(report["job"]["images"]),
        job("ms_trace"), job("ms_form"), job("ms_facts"), job("ms_files"), job("times_131k_rays"),
        job("ms_set_up"));
    return text;
}

}  // namespace sonarsim
