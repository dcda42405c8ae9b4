#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// The pixels of one object in a picture: a box, and runs.
struct ObjectMask {
    std::uint32_t id = 0;
    int left = 0, right = 0;  ///< columns [left, right)
    int top = 0, bottom = 0;  ///< rows [top, bottom)
    std::uint64_t area = 0;   ///< pixels
    /// Lengths of the runs in turn outside and inside of the object, column after column, each from
    /// the top; they add up to all pixels, and only the first may be 0.
    std::vector<std::uint32_t> runs;
};

/// The objects of a picture by their ids. `ids` holds the columns one after the other, each from
/// the top, `height` pixels long; 0 is none.
std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height);

}  // namespace sonarsim
