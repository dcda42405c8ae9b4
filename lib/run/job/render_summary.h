#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "output/dataset/sensor_summary.h"
#include "run/checks/warning.h"

namespace sonarsim {

struct RenderSummary {
    std::uint64_t pings = 0;    ///< rendered by this run
    std::uint64_t skipped = 0;  ///< not rendered: their files were there already
    bool complete = false;      ///< the folder now holds every ping of every shard
    bool stopped = false;       ///< ended early on request
    bool unlocked = false;      ///< the disk has no locks that would refuse a second run
    double seconds = 0.0;       ///< wall clock from the first ping to the last
    PingSeconds stages;         ///< summed over the pings, and so over threads
    double label_seconds = 0.0;
    double encode_seconds = 0.0;
    double write_seconds = 0.0;
    PingCounts counts;                   ///< summed over the pings
    std::vector<Warning> warnings;       ///< from the engine; of variants also about the images
    std::uint64_t clipped_pixels = 0;    ///< intensities above full_scale, where files were written
    std::vector<SensorSummary> sensors;  ///< in the order of Mission::sensors

    /// Adds the sums over pings, and no more.
    RenderSummary& operator+=(const RenderSummary& more) {
        pings += more.pings;
        skipped += more.skipped;
        stages += more.stages;
        label_seconds += more.label_seconds;
        encode_seconds += more.encode_seconds;
        write_seconds += more.write_seconds;
        counts += more.counts;
        clipped_pixels += more.clipped_pixels;
        sensors.resize(std::max(sensors.size(), more.sensors.size()));
        for (std::size_t i = 0; i < more.sensors.size(); ++i)
            sensors[i] += more.sensors[i];
        return *this;
    }
};

/// As ProgressCallback, with the sums over the pings so far.
using JobCallback = std::function<void(const RenderSummary& so_far, std::uint64_t total)>;

}  // namespace sonarsim
