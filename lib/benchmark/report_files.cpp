#include "benchmark/report_files.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "benchmark/report_text.h"
#include "core/text.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The figures of a row with their least and greatest value over the poses.
std::vector<std::pair<const char*, const Summary*>> summaries(const ReportRow& row) {
    return {{"ms_per_ping", &row.ms_per_ping}, {"relative_l1", &row.relative_l1},
            {"relative_l2", &row.relative_l2}, {"miss_rate", &row.miss_rate},
            {"false_rate", &row.false_rate},   {"samples_per_ping", &row.samples_per_ping}};
}

/// The other figures of a row, in the order of the columns.
std::vector<std::pair<const char*, double>> columns_of(const ReportRow& row) {
    return {{"ms_per_ping", row.ms_per_ping.centre},
            {"pings_per_s", row.pings_per_s},
            {"times_131k_rays", row.times_rays},
            {"relative_l1", row.relative_l1.centre},
            {"worst_relative_l1", row.relative_l1.max},
            {"relative_l2", row.relative_l2.centre},
            {"miss_rate", row.miss_rate.centre},
            {"false_rate", row.false_rate.centre},
            {"samples_per_ping", row.samples_per_ping.centre},
            {"build_s", row.cold.build_s},
            {"first_ping_s", row.cold.first_ping_s},
            {"peak_memory_mb", row.cold.peak_memory_mb}};
}

Json json_of(const ReportRow& row) {
    Json json{{"sensor", row.sensor},
              {"engine", row.setting.engine},
              {"setting", row.setting.name},
              {"promise", row.promise()}};
    for (const auto& [name, value] : columns_of(row))
        json[name] = value;
    for (const auto& [name, spread] : summaries(row))
        json["spread"][name] = {spread->min, spread->max};
    return json;
}

Json stages_of(const ReportRow& row) {
    Json json = {{"sensor", row.sensor},
                 {"engine", row.setting.engine},
                 {"setting", row.setting.name},
                 {"on_front", row.on_front},
                 {"current", row.setting.current}};
    for (const auto& timer : ping_timers)
        json["ms_" + std::string(timer.name)] = 1e3 * row.stages.*timer.member;
    json["ms_bare_embree"] = row.ms_bare;
    json["ms_131k_rays"] = row.ms_rays;
    json["ms_slowest_ping"] = row.cold.slowest_ms;
    json["engine_memory_mb"] = row.cold.engine_memory_mb;
    return json;
}

Json reference_of(const Report& report, const ReferenceQuality& reference) {
    return {{"sensor", reference.sensor},
            {"poses", report.poses},
            {"moved_mean", reference.moved.centre},
            {"moved_max", reference.moved.max},
            {"apart_mean", reference.apart.centre},
            {"apart_max", reference.apart.max},
            {"rays_per_bin_mean", reference.rays_per_bin.centre},
            {"auto", explain_auto(report, reference.sensor)}};
}

Json growth_of(const Growth& growth) {
    Json json{{"sensor", growth.sensor},
              {"engine", growth.engine},
              {"along", growth.along},
              {"triangles", growth.triangles},
              {"ms_per_ping", growth.ms_per_ping}};
    // JSON has no NaN.
    json["exponent"] = std::isfinite(growth.exponent) ? Json(growth.exponent) : Json();
    return json;
}

/// The figures of a multipath row: epsilon and delta, then the measurements.
std::vector<std::pair<const char*, double>> columns_of(const MultipathRow& row) {
    return {{"epsilon_bins", row.setting.epsilon_bins},
            {"delta_deg", row.setting.delta_deg},
            {"relative_l1", row.relative_l1},
            {"recall", row.recall},
            {"precision", row.precision},
            {"exact_bins", static_cast<double>(row.exact_bins)},
            {"ms_multipath", row.ms_multipath.centre},
            {"ms_multipath_min", row.ms_multipath.min},
            {"ms_multipath_max", row.ms_multipath.max},
            {"ms_per_ping", row.ms_per_ping.centre},
            {"ms_per_ping_min", row.ms_per_ping.min},
            {"ms_per_ping_max", row.ms_per_ping.max},
            {"ms_without", row.ms_without},
            {"times_without", row.times_without()},
            {"speed_up", row.speed_up}};
}

const char* method_of(const MultipathRow& row) {
    return row.setting.method == MultipathMethod::exact ? "exact" : "cluster";
}

Json json_of(const MultipathRow& row) {
    Json json{{"sensor", row.sensor}, {"method", method_of(row)}, {"current", row.current}};
    for (const auto& [name, value] : columns_of(row))
        json[name] = value;
    return json;
}

Json json_of(const LabelRow& row) {
    return {{"sensor", row.sensor},
            {"label", row.label},
            {"ms", row.ms.centre},
            {"times_ping", row.times_ping.centre},
            {"times_ping_min", row.times_ping.min},
            {"times_ping_max", row.times_ping.max}};
}

}  // namespace

std::string report_json(const Report& report) {
    Json json{{"mission", report.mission},      {"version", SONARSIM_VERSION},
              {"triangles", report.triangles},  {"poses", report.poses},
              {"threads", report.threads},      {"load_average", report.load},
              {"goal_relative_l1", report.goal}};
    for (const char* const list :
         {"rows", "stages", "reference", "growth", "multipath_rows", "label_rows"})
        json[list] = Json::array();
    for (const ReportRow& row : report.rows) {
        json["rows"].push_back(json_of(row));
        json["stages"].push_back(stages_of(row));
    }
    for (const ReferenceQuality& reference : report.references)
        json["reference"].push_back(reference_of(report, reference));
    for (const Growth& growth : report.growth)
        json["growth"].push_back(growth_of(growth));
    for (const MultipathRow& row : report.multipath)
        json["multipath_rows"].push_back(json_of(row));
    for (const LabelRow& row : report.labels)
        json["label_rows"].push_back(json_of(row));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_csv(const Report& report) {
    std::string text = "sensor,engine,setting,promise";
    const ReportRow any;
    for (const auto& [name, value] : columns_of(any))
        text += std::string(",") + name;
    for (const auto& [name, spread] : summaries(any))
        text += "," + std::string(name) + "_min," + name + "_max";
    text += "\n";
    for (const ReportRow& row : report.rows) {
        text +=
            row.sensor + "," + row.setting.engine + "," + row.setting.name + "," + row.promise();
        for (const auto& [name, value] : columns_of(row))
            text += "," + number_text(value);
        for (const auto& [name, spread] : summaries(row))
            text += "," + number_text(spread->min) + "," + number_text(spread->max);
        text += "\n";
    }
    return text;
}

std::string multipath_csv(const Report& report) {
    std::string text = "sensor,method,current";
    for (const auto& [name, value] : columns_of(MultipathRow{}))
        text += std::string(",") + name;
    text += "\n";
    for (const MultipathRow& row : report.multipath) {
        text += row.sensor + "," + method_of(row) + "," + (row.current ? "true" : "false");
        for (const auto& [name, value] : columns_of(row))
            text += "," + number_text(value);
        text += "\n";
    }
    return text;
}

}  // namespace sonarsim
