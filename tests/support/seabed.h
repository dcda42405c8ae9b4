#pragma once

#include "input/scene/seabed/seabed.h"

namespace sonarsim::test {

/// A bed, and the part of it that is made.
struct SeabedRule : SeabedConfig {
    std::uint64_t seed = 0;
    std::array<double, 4> window{};  ///< least x and y, largest x and y
};

inline Seabed make_seabed(const SeabedRule& rule) {
    const auto& [west, south, east, north] = rule.window;
    return sonarsim::make_seabed(rule, rule.seed,
                                 {Eigen::Vector2d(west, south), Eigen::Vector2d(east, north)});
}

}  // namespace sonarsim::test
