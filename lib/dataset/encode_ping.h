#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dataset/writers.h"

namespace sonarsim {

/// The output of the writers of a sensor for a ping.
struct WrittenPing {
    std::vector<std::string> parts;    ///< by writer: the bytes of a file or a record
    std::uint64_t clipped_pixels = 0;  ///< intensities above the white of pictures
};

/// Hands a ping to the writers of its sensor. `plan` is that of the sensor; `engine` and `sonar`
/// are those that the ping was traced with.
WrittenPing encode_ping(const Assembly& assembly, const VisibilityEngine& engine,
                        const Writers& writers, const LabelPlan& plan, const PingId& id,
                        const Sonar& sonar, const TracedPing& traced, const Ping& ping);

}  // namespace sonarsim
