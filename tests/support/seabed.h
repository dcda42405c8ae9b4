#pragma once

#include "input/scene/seabed/seabed.h"

namespace sonarsim::test {

/// A bed, and the part of it that is made.
struct SeabedRule : SeabedConfig {
    std::uint64_t seed = 0;
    BedArea window{};
};

inline Seabed make_seabed(const SeabedRule& rule) {
    return sonarsim::make_seabed(rule, rule.seed, rule.window);
}

}  // namespace sonarsim::test
