#include "study/report_files.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/text.h"
#include "study/report_text.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The figures of a row that vary over the poses.
std::vector<std::pair<const char*, const Spread*>> spreads(const ReportRow& row) {
    return {{"ms_per_ping", &row.ms_per_ping}, {"relative_l1", &row.relative_l1},
            {"relative_l2", &row.relative_l2}, {"miss_rate", &row.miss_rate},
            {"false_rate", &row.false_rate},   {"samples_per_ping", &row.samples_per_ping}};
}

Json json_of(const ReportRow& row) {
    Json json{{"sensor", row.sensor},
              {"engine", row.setting.engine},
              {"setting", row.setting.name},
              {"ms_per_ping", row.ms_per_ping.centre},
              {"pings_per_s", row.pings_per_s},
              {"relative_l1", row.relative_l1.centre},
              {"relative_l2", row.relative_l2.centre},
              {"miss_rate", row.miss_rate.centre},
              {"false_rate", row.false_rate.centre},
              {"samples_per_ping", row.samples_per_ping.centre},
              {"build_s", row.cold.build_s},
              {"first_ping_s", row.cold.first_ping_s},
              {"peak_memory_mb", row.cold.peak_memory_mb}};
    for (const auto& [name, spread] : spreads(row)) {
        json["spread"][name] = {spread->min, spread->max};
    }
    return json;
}

Json stages_of(const ReportRow& row) {
    return {{"sensor", row.sensor},
            {"engine", row.setting.engine},
            {"setting", row.setting.name},
            {"on_front", row.on_front},
            {"current", row.setting.current},
            {"ms_trace", row.ms_trace},
            {"ms_accumulate", row.ms_accumulate},
            {"ms_noise", row.ms_noise},
            {"ms_bare_embree", row.ms_bare},
            {"ms_slowest_ping", row.cold.slowest_ms},
            {"engine_memory_mb", row.cold.engine_memory_mb}};
}

Json reference_of(const Report& report, const ReferenceQuality& reference) {
    return {{"sensor", reference.sensor},
            {"poses", report.poses},
            {"moved_mean", reference.moved.centre},
            {"moved_max", reference.moved.max},
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

}  // namespace

std::string report_json(const Report& report) {
    Json json{{"mission", report.mission},      {"version", SONARSIM_VERSION},
              {"triangles", report.triangles},  {"poses", report.poses},
              {"threads", report.threads},      {"load_average", report.load},
              {"goal_relative_l1", report.goal}};
    for (const char* const list : {"rows", "stages", "reference", "growth"})
        json[list] = Json::array();
    for (const ReportRow& row : report.rows) {
        json["rows"].push_back(json_of(row));
        json["stages"].push_back(stages_of(row));
    }
    for (const ReferenceQuality& reference : report.references)
        json["reference"].push_back(reference_of(report, reference));
    for (const Growth& growth : report.growth)
        json["growth"].push_back(growth_of(growth));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_csv(const Report& report) {
    std::string text =
        "sensor,engine,setting,ms_per_ping,pings_per_s,relative_l1,relative_l2,miss_rate,"
        "false_rate,samples_per_ping,build_s,first_ping_s,peak_memory_mb";
    for (const auto& [name, spread] : spreads(ReportRow{})) {
        text += "," + std::string(name) + "_min," + name + "_max";
    }
    text += "\n";
    for (const ReportRow& row : report.rows) {
        text += row.sensor + "," + row.setting.engine + "," + row.setting.name;
        for (const double value :
             {row.ms_per_ping.centre, row.pings_per_s, row.relative_l1.centre,
              row.relative_l2.centre, row.miss_rate.centre, row.false_rate.centre,
              row.samples_per_ping.centre, row.cold.build_s, row.cold.first_ping_s,
              row.cold.peak_memory_mb}) {
            text += "," + number_text(value);
        }
        for (const auto& [name, spread] : spreads(row)) {
            text += "," + number_text(spread->min) + "," + number_text(spread->max);
        }
        text += "\n";
    }
    return text;
}

}  // namespace sonarsim
