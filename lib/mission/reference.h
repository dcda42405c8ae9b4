#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/limits.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// What a user is told of one key.
struct KeyReference {
    std::string name;
    std::string type;  ///< "number", "whole number", "true or false", "section", ...
    std::string unit;  ///< "" where there is none
    bool required = false;
    /// The kind of sonar and the default that it gives, as YAML. Keys that no kind of sonar changes
    /// have one entry with an empty kind. A key that a kind lacks has no entry for it.
    std::vector<std::pair<std::string, std::string>> defaults;
    std::optional<Limits> limits;      ///< of a number, or of every number of a list
    std::vector<std::string> choices;  ///< what may be named; empty where anything may
    std::string meaning;
};

/// The keys that stand together in one section of a mission.
struct SectionReference {
    std::string path;  ///< keys with dots, as --set takes them; "" is the whole mission
    std::string form;  ///< the key that picks this form, where a section has several
    std::vector<KeyReference> keys;
    std::vector<std::string> checks;  ///< what must hold across keys
};

/// Every key that a mission may have, as mission/schema.h describes them.
std::vector<SectionReference> mission_reference(SonarKeyTable sonars);

}  // namespace sonarsim
