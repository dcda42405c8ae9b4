#include "dataset/description.h"

#include <algorithm>

#include "core/text.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

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

/// The properties of a dataset's build that its bytes depend on.
std::string bytes_of_build(const Json& description) {
    const Json build = description.value("build", Json());
    std::string text;
    for (const char* key : {"arithmetic", "png_encoder"}) {
        const bool known = build.is_object() && build.contains(key) && build[key].is_string();
        text += (text.empty() ? "" : ", ") + (known ? build[key].get<std::string>() : "unknown");
    }
    return text;
}

}  // namespace

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

}  // namespace sonarsim
