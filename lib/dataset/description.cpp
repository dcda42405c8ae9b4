#include "dataset/description.h"

#include <algorithm>

#include "core/text.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// Returns false if `visit` did.
bool visit_pings(const DescribedSensor& sensor, const std::string& kind, const std::string& pattern,
                 const std::function<bool(const DescribedFile&)>& visit) {
    for (std::uint64_t ping = 0; ping < sensor.pings; ++ping) {
        if (!visit({numbered(pattern, ping * sensor.every), &sensor, kind})) return false;
    }
    return true;
}

bool visit_sensor(const DescribedSensor& sensor,
                  const std::function<bool(const DescribedFile&)>& visit) {
    for (const auto& [kind, pattern] : sensor.files) {
        if (!visit_pings(sensor, kind, pattern, visit)) return false;
    }
    if (sensor.records && !visit({*sensor.records, &sensor, "records"})) return false;
    for (const auto& [label, file] : sensor.label_records) {
        if (!visit({file, &sensor, "label_records/" + label})) return false;
    }
    return std::ranges::all_of(sensor.products, [&](const std::string& product) {
        return visit({product, &sensor, {}});
    });
}

/// " (mesh.glb, path.csv)": the input files whose content differs; "" if none is listed.
std::string changed_inputs(const Json& found, const Json& expected) {
    const Json before = found.value("inputs", Json::array());
    std::string names;
    for (const Json& input : expected.value("inputs", Json::array())) {
        if (std::ranges::find(before, input) != before.end()) continue;
        names += (names.empty() ? " (" : ", ") + printable(input.value("file", ""));
    }
    return names.empty() ? "" : names + ")";
}

}  // namespace

std::string bytes_of_build(const Json& description) {
    const Json build = description.value("build", Json());
    std::string text;
    for (const char* key : {"arithmetic", "png_encoder"}) {
        const bool known = build.is_object() && build.contains(key) && build[key].is_string();
        text += (text.empty() ? "" : ", ") + (known ? build[key].get<std::string>() : "unknown");
    }
    return text;
}

std::string difference_between(const Json& found, const Json& expected) {
    const auto differs = [&](const char* key) {
        return found.value(key, Json()) != expected.value(key, Json());
    };
    if (differs("mission_hash")) return of_another_mission;
    if (differs("inputs_hash"))
        return "of this mission made from other scene, material or trajectory files" +
               changed_inputs(found, expected);
    if (differs("program_version") || differs("format_version"))
        return "of this mission made by another version of sonarsim";
    const std::string theirs = bytes_of_build(found);
    const std::string ours = bytes_of_build(expected);
    if (theirs == ours) return {};
    return "of this mission made by a build of sonarsim whose bytes differ (" + theirs +
           "; this one: " + ours + ")";
}

void for_each_described(const DatasetFile& dataset,
                        const std::function<bool(const DescribedFile&)>& visit) {
    for (const char* name :
         {description_name, mission_name, trajectory_name, journal_name, checksums_name}) {
        if (!visit({name, nullptr, {}})) return;
    }
    for (const DescribedSensor& sensor : dataset.sensors) {
        if (!visit_sensor(sensor, visit)) return;
    }
    for (const std::string& product : dataset.products) {
        if (!visit({product, nullptr, {}})) return;
    }
}

}  // namespace sonarsim
