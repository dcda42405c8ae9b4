#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mission/document.h"

namespace sonarsim {

/// A kind of sonar of HoloOcean. Since version 2.4 each is there three times: by octree, by ray
/// casts and on the GPU.
struct SonarType {
    const char* type;
    const char* kind;
    bool looks_down;                      ///< by sonarsim's default mount
    std::vector<std::string_view> lacks;  ///< keys that the kind does not have
    const char* azimuth_deg = "";         ///< its default, where sonarsim's differs
    const char* remark = "";              ///< how the imported sonar differs from it
};

/// All of them.
std::span<const SonarType> sonar_types();
/// Their names, separated by commas.
std::string sonar_type_list();

/// Keys of a mission and their values.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Where the key is set already, the later value counts.
void set_key(Settings& settings, const std::string& key, const std::string& value);
/// The value of a key; nullptr where it is not set.
const std::string* setting(const Settings& settings, std::string_view key);

/// What the `configuration` of a sonar becomes.
struct ImportedSonar {
    Settings settings;                 ///< of the sonar, with dots: noise.add_sigma
    Settings water;                    ///< of the mission's water
    std::vector<std::string> remarks;  ///< what has no counterpart, and why
};

/// Adds a warning for each parameter without a counterpart. InputError for a wrong value.
ImportedSonar import_sonar(const YamlNode& sensor, const SonarType& type,
                           std::vector<std::string>& warnings);

}  // namespace sonarsim
