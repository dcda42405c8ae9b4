#pragma once

#include <cstdint>

namespace sonarsim {

/// Four 32-bit words: the counter that goes into Philox and the random words that come out.
struct PhiloxBlock {
    std::uint32_t x0, x1, x2, x3;
};

/// The 64-bit key of Philox: what names a family of draws.
struct PhiloxKey {
    std::uint32_t k0, k1;
};

/// Philox4x32-10 of Salmon et al., "Parallel random numbers: as easy as 1, 2, 3" (SC11), the same
/// function as in Random123. Written out so that a loop over counters vectorises, which
/// Random123's array types do not; a test holds the two against each other.
inline PhiloxBlock philox(PhiloxBlock c, PhiloxKey key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53U} * c.x0;
        const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * c.x2;
        c = {static_cast<std::uint32_t>(b >> 32) ^ c.x1 ^ key.k0, static_cast<std::uint32_t>(b),
             static_cast<std::uint32_t>(a >> 32) ^ c.x3 ^ key.k1, static_cast<std::uint32_t>(a)};
        key.k0 += 0x9E3779B9U;
        key.k1 += 0xBB67AE85U;
    }
    return c;
}

/// A float in (0, 1): the midpoint of one of 2^24 equal cells, so neither 0 nor 1 occurs and the
/// logarithm of it is finite.
inline float unit_float(std::uint32_t word) {
    return (static_cast<float>(static_cast<std::int32_t>(word >> 8)) + 0.5F) * 0x1p-24F;
}

/// What a draw is for. Draws of different streams never share a number.
enum class Stream : std::uint32_t { range_noise = 1, pixel_noise = 2, multipath_range_noise = 3 };

/// The key of one stream of one ping of one sensor. The counter below it names what the draw
/// belongs to (a scatterer cell, a pixel).
inline PhiloxKey stream_key(std::uint64_t seed, std::uint32_t sensor, std::uint32_t ping,
                            Stream stream) {
    const PhiloxBlock block =
        philox({sensor, ping, static_cast<std::uint32_t>(stream), 0x736f6e61U},
               {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    return {block.x0, block.x1};
}

}  // namespace sonarsim
