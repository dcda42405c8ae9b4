#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace sonarsim {

/// The pixels of one object in a picture: a bounding box and runs.
struct ObjectMask {
    std::uint32_t id = 0;
    int left = 0, right = 0;  ///< columns [left, right)
    int top = 0, bottom = 0;  ///< rows [top, bottom)
    std::uint64_t area = 0;   ///< pixels
    /// Lengths of runs, alternately outside and inside the object, column after column from the
    /// top. They add up to all pixels; only the first may be 0.
    std::vector<std::uint32_t> runs;
};

/// The end of the run of equal ids that begins at a place.
inline std::size_t end_of_run(std::span<const std::uint16_t> ids, std::size_t from) {
    constexpr std::size_t at_once = 4;
    const std::uint64_t same = ids[from] * std::uint64_t{0x0001000100010001};
    std::size_t to = from + 1;
    for (std::uint64_t next; to + at_once <= ids.size(); to += at_once) {
        std::memcpy(&next, &ids[to], sizeof next);
        if (next != same) break;
    }
    while (to < ids.size() && ids[to] == ids[from])
        ++to;
    return to;
}

/// The masks of a picture's objects, sorted by id. `ids` holds the columns one after the other,
/// each `height` pixels from the top; 0 means no object.
std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height);

}  // namespace sonarsim
