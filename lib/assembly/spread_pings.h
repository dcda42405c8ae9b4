#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonarsim {

/// The poses of at most `most` pings of a sonar that pings at every n-th of `poses`: those in the
/// middle of equal parts of its way, whatever part of it is rendered.
inline std::vector<std::uint32_t> spread_pings(std::size_t poses, int every, std::size_t most) {
    const auto step = static_cast<std::size_t>(every);
    const std::size_t pings = (poses + step - 1) / step;
    const std::size_t count = std::min(pings, most);
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < count; ++k)
        chosen.push_back(static_cast<std::uint32_t>((2 * k + 1) * pings / (2 * count) * step));
    return chosen;
}

}  // namespace sonarsim
