#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonarsim {

/// The poses of at most `most` pings of a sonar that pings at every `every`-th of `poses` poses:
/// the middles of equal parts of the whole trajectory, whichever part is rendered.
inline std::vector<std::uint32_t> sample_pings(std::size_t poses, int every, std::size_t most) {
    const auto step = static_cast<std::size_t>(every);
    const std::size_t pings = (poses + step - 1) / step;
    const std::size_t count = std::min(pings, most);
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < count; ++k)
        chosen.push_back(static_cast<std::uint32_t>((2 * k + 1) * pings / (2 * count) * step));
    return chosen;
}

}  // namespace sonarsim
