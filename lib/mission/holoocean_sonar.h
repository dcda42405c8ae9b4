#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mission/document.h"

namespace sonarsim {

/// A kind of sonar of HoloOcean. Since version 2.4 each has three forms: with the octree, with ray
/// casts and on the GPU.
struct SonarType {
    const char* type;
    const char* kind;
    bool looks_down;                      ///< the default mount of sonarsim's kind looks down
    std::vector<std::string_view> lacks;  ///< keys that the kind does not have
    const char* azimuth_deg = "";         ///< HoloOcean's default, if sonarsim's differs
    const char* remark = "";              ///< differences of the imported sonar from HoloOcean's
};

/// All kinds of sonar of HoloOcean.
std::span<const SonarType> sonar_types();
/// The names of these kinds, separated by commas.
std::string sonar_type_list();

/// Keys of a mission and their values.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Sets a key, or replaces its value.
void set_key(Settings& settings, const std::string& key, const std::string& value);
/// The value of a key; nullptr if it is not set.
const std::string* setting(const Settings& settings, std::string_view key);

/// The mission's keys for the `configuration` of a sonar.
struct ImportedSonar {
    Settings settings;                 ///< keys of the sonar, with dots: noise.add_sigma
    Settings water;                    ///< keys of the mission's water
    std::vector<std::string> remarks;  ///< parameters without a counterpart, and the reasons
};

/// Adds a warning for each parameter without a counterpart. InputError for a wrong value.
ImportedSonar import_sonar(const YamlNode& sensor, const SonarType& type,
                           std::vector<std::string>& warnings);

}  // namespace sonarsim
