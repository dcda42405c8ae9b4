#pragma once

#include <cstdint>
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

/// The masks of a picture's objects, sorted by id. `ids` holds the columns one after the other,
/// each `height` pixels from the top; 0 means no object.
std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height);

}  // namespace sonarsim
