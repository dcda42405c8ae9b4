#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/limits.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// The documentation of one key.
struct KeyReference {
    std::string name;
    std::string type;  ///< "number", "whole number", "true or false", "section", ...
    std::string unit;  ///< "": none
    bool required = false;
    /// Pairs of a kind of sonar and its default, as YAML. A key whose default does not depend on
    /// the kind has one entry with an empty kind. There is no entry for kinds without the key.
    std::vector<std::pair<std::string, std::string>> defaults;
    std::optional<Limits> limits;      ///< limits of a number, or of every number of a list
    std::vector<std::string> choices;  ///< allowed names; empty: anything
    std::string meaning;
};

/// The keys of one section of a mission.
struct SectionReference {
    std::string path;  ///< keys with dots, as --set takes them; "" is the whole mission
    std::string form;  ///< the key that selects this form of a section with several forms
    std::vector<KeyReference> keys;
    std::vector<std::string> checks;  ///< conditions on several keys
};

/// The sections of a mission while its keys are visited: a sonar once for each kind and model, a
/// trajectory once for each form.
class KeyTables {
  public:
    /// Adds a key after the one that was added before. `kind`: the kind of the visited sonar. A key
    /// that the section has gets the default of this kind.
    void add(const std::string& path, const std::string& form, const std::string& kind,
             KeyReference key, const std::string& default_text);
    void add_check(const std::string& path, const std::string& form, const std::string& check);

    std::vector<SectionReference> sections;

  private:
    SectionReference& section(const std::string& path, const std::string& form);

    std::string last_key_;
};

/// All keys of a mission, as mission/schema.h describes them.
std::vector<SectionReference> mission_reference(SonarKeyTable sonars);

}  // namespace sonarsim
