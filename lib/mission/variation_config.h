#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/place.h"

namespace sonarsim {

/// Values of any kind, as YAML.
struct YamlValues {
    std::vector<std::string> items;

    bool operator==(const YamlValues&) const = default;
};

/// When a key is drawn: for each variant, once for all variants, or for every ping.
enum class VaryPer { variant, dataset, ping };

/// A key of the mission that is drawn at random. Exactly one of the distributions is given.
struct VaryConfig {
    std::string key;  ///< as in --set
    VaryPer per = VaryPer::variant;
    std::optional<std::array<double, 2>> uniform;      ///< least and largest
    std::optional<std::array<double, 2>> log_uniform;  ///< uniform in the logarithm
    std::optional<std::array<double, 2>> whole;        ///< whole numbers, both ends included
    std::optional<std::array<double, 2>> normal;       ///< mean and standard deviation
    std::optional<std::array<double, 2>> within;       ///< limits of a normal draw
    YamlValues choice;                                 ///< all equally likely
    MissionPlace place;

    bool operator==(const VaryConfig&) const = default;
};

/// Keys of a mission and the values drawn for them, as YAML text.
using DrawnValues = std::vector<std::pair<std::string, std::string>>;

/// The variant of a mission.
struct Variant {
    int index = -1;  ///< -1: none
    int of = 0;      ///< number of variants
    DrawnValues drawn;
    std::vector<std::string> classes;  ///< classes of all choices of `vary`
    /// Likewise the instances, each with the class that its file gives it.
    std::vector<std::pair<std::string, std::string>> instances;

    bool operator==(const Variant&) const = default;
};

}  // namespace sonarsim
