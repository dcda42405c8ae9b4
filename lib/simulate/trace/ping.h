#pragma once

#include <limits>
#include <vector>

#include "core/random.h"
#include "simulate/trace/counters.h"

namespace sonarsim {

/// One ping of one sonar: the image, row by row.
struct Ping {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], 0 where nothing is seen
    PingCounts counts;
    PingSeconds seconds;

    float at(int range_bin, int beam) const {
        return intensity[static_cast<std::size_t>(range_bin) * beams + beam];
    }
};

/// The random draws of one ping of one sonar.
struct PingDraws {
    std::uint64_t seed = 0;
    std::uint32_t sensor = 0;  ///< names the sonar
    std::uint32_t ping = 0;    ///< index of the pose on the trajectory
    std::uint32_t group = 0;   ///< the shutter's

    PhiloxKey of(Stream stream) const { return stream_key(seed, sensor, ping, stream); }
    /// Draws of what is received with one group of a shutter.
    PhiloxKey received(Stream stream) const {
        const PhiloxKey key = of(stream);
        return {key.k0 ^ (group * 0x9E3779B9U), key.k1};
    }
    /// Draws that belong to the scene: the same for all sonars and pings.
    PhiloxKey scene_key(Stream stream) const { return stream_key(seed, 0, 0, stream); }
};

/// The terms of an echo model that an image is made of, where the sonar's settings use them.
struct Terms {
    static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

    bool direct = true;        ///< echoes of the visible surface
    bool multipath = true;     ///< echoes over a second surface
    bool water = true;         ///< echoes of the water: its volume and what KindOfSample says
    std::size_t random = all;  ///< number of random terms, the first of EchoModelInfo::random_terms
};

inline constexpr Terms direct_echoes_alone{.multipath = false, .random = 0};
/// The terms of a reference.
inline constexpr Terms surface_alone{.multipath = false, .water = false, .random = 0};
inline constexpr Terms multipath_alone{.direct = false, .random = 0};
inline constexpr Terms without_random_terms{.random = 0};

}  // namespace sonarsim
