#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "dataset/npy.h"
#include "ping/ping.h"
#include "sonar/sonar.h"
#include "visibility/engine.h"

namespace sonarsim {

/// What a dataset keeps of a ping besides its images.
struct Measurement {
    std::string record;              ///< the bytes of its record; empty when imaging
    nlohmann::ordered_json summary;  ///< what its metadata say of it; null when imaging
};

/// side-scan: a row of the waterfall; the altitude and the first bottom return on either side.
/// echosounder: a column of the echogram; the altitude and the detected depth.
/// profiling: a row of range, x, y, z and quality per beam; the altitude and how many soundings.
/// The altitude is the truth: how far below the sonar the scene begins. What is absent is null.
Measurement measure(const Sonar& sonar, const VisibilityEngine& engine, const Pose& T_world_vehicle,
                    const Ping& ping);

/// The file that holds the records of `pings` pings.
NpyFormat record_format(const Sonar& sonar, std::size_t pings);

/// Numbers per sounding in a record.
inline constexpr std::size_t sounding_fields = 5;

}  // namespace sonarsim
