#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dataset/writers.h"

namespace sonarsim {

/// What the writers of a sensor make of a ping.
struct WrittenPing {
    std::vector<std::string> parts;    ///< by writer: the bytes of a file or a record
    std::uint64_t clipped_pixels = 0;  ///< intensities above the white of pictures
};

/// Hands a ping to the writers of its sensor. `plan` is that of the sensor; `engine` is the one
/// that the ping was traced with.
WrittenPing encode_ping(const Assembly& assembly, const VisibilityEngine& engine,
                        const Writers& writers, const LabelPlan& plan, const PingId& id,
                        const TracedPing& traced, const Ping& ping);

}  // namespace sonarsim
