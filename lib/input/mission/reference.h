#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input/mission/limits.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// The documentation of one key.
struct KeyReference {
    std::string name;
    std::string type;  ///< "number", "whole number", "true or false", "section", ...
    std::string unit;  ///< "": none
    bool required = false;
    /// Pairs of a kind of sonar and its default, as YAML. A key whose default does not depend on
    /// the kind has one entry with an empty kind. There is no entry for kinds without the key.
    std::vector<std::pair<std::string, std::string>> defaults = {};
    std::optional<Limits> limits;           ///< limits of a number, or of every number of a list
    std::vector<std::string> choices = {};  ///< allowed names; empty: anything
    std::string meaning;
    /// The kinds and models of the sonars with this key, as "imaging, paper". Else one empty text.
    std::vector<std::string> sonars = {};
};

/// The keys of one section of a mission. A section with several forms has one of these for each.
struct SectionReference {
    std::string path;  ///< keys with dots, as --set takes them; "" is the whole mission
    std::string form;  ///< the key that selects this form of a section with several forms
    std::vector<KeyReference> keys;
    std::vector<std::string> checks;  ///< conditions on several keys
};

/// All keys of a mission, by input/mission/mission.h. All trajectories have the vehicle's.
std::vector<SectionReference> mission_reference(SonarKeyTable sonars);

/// Makes a Markdown table per section: key, type and unit, default, range, meaning.
std::string reference_markdown(const std::vector<SectionReference>& sections);

/// The JSON Schema (2020-12) of a mission, with which editors complete and check missions: type,
/// limits, default, choices and meaning of each key, the required keys, and the keys of each kind
/// of sonar. A schema cannot express checks across keys; they are each section's `$comment`.
nlohmann::ordered_json reference_schema(const std::vector<SectionReference>& sections,
                                        SonarKeyTable sonars);

}  // namespace sonarsim
