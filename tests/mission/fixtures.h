#pragma once

#include "input/mission/parse.h"
#include "input/mission/resolved.h"
#include "simulate/sonar/kinds.h"
#include "support/test.h"

namespace sonarsim {

/// The shortest mission that is valid, in five lines. A test adds what it is about.
static const std::string smallest_mission =
    "scene: {file: a.glb, materials: a.csv}\n"
    "trajectory: {file: a.tum}\n"
    "sensors:\n"
    "  fls:\n"
    "    kind: imaging\n";

inline Mission parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return parse_mission(text, "m.yaml", "/base", overrides, sonar_keys());
}

/// All values of a mission, for comparisons.
inline std::string yaml_of(const Mission& mission) {
    return resolved_yaml(mission, sonar_keys());
}

/// True if the mission, written as YAML, is read as the same mission.
inline bool reads_back(const Mission& mission) {
    return yaml_of(parse(yaml_of(mission))) == yaml_of(mission);
}

/// The first fault of the InputError that reading `text` ends in; "" when it does not.
inline std::string refusal(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
    const std::string faults = test::fault_of([&] { parse(text, overrides); });
    return faults.substr(0, faults.find('\n'));
}

/// An addition to a text, and its refusal without "m.yaml:": place and sentence.
struct Refused {
    std::string text, message;
};

inline void check_refused(const std::string& before, const std::vector<Refused>& cases,
                          const std::string& after = "") {
    for (const Refused& one : cases)
        CHECK(refusal(before + one.text + after) == "m.yaml:" + one.message);
}

}  // namespace sonarsim
