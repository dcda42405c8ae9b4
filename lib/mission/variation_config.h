#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/place.h"

namespace sonarsim {

/// What is drawn for each variant, once for all of them, or for every ping.
enum class VaryPer { variant, dataset, ping };

/// A key of the mission that is drawn at random; exactly one of the distributions is given.
struct VaryConfig {
    std::string key;  ///< as --set takes it
    VaryPer per = VaryPer::variant;
    std::optional<std::array<double, 2>> uniform;      ///< least and largest
    std::optional<std::array<double, 2>> log_uniform;  ///< the same, uniform in the logarithm
    std::optional<std::array<double, 2>> whole;        ///< whole numbers, both ends included
    std::optional<std::array<double, 2>> normal;       ///< mean and standard deviation
    std::optional<std::array<double, 2>> within;       ///< a normal draw outside is drawn again
    std::vector<std::string> choice;                   ///< YAML texts, each as likely as another
    Place place;

    bool operator==(const VaryConfig&) const = default;
};

/// Keys of a mission and what was drawn for them, as YAML text.
using DrawnValues = std::vector<std::pair<std::string, std::string>>;

/// Which variant of a mission this is.
struct Variant {
    int index = -1;  ///< -1: none
    int of = 0;
    DrawnValues drawn;

    bool operator==(const Variant&) const = default;
};

}  // namespace sonarsim
