#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace sonarsim {

/// The values of one image, [range, beam], a range after the other.
struct ImageView {
    std::span<const float> values;
    int ranges = 0;
    int beams = 0;

    float at(int range, int beam) const {
        return values[static_cast<std::size_t>(range) * static_cast<std::size_t>(beams) +
                      static_cast<std::size_t>(beam)];
    }
};

struct PatchSize {
    int ranges = 32;
    int beams = 16;

    int values() const { return ranges * beams; }
};

/// The patches of an image, which do not overlap, numbered a row after the other. Ranges and beams
/// that fill no patch are left out.
struct PatchGrid {
    PatchSize size;
    int rows = 0;
    int columns = 0;

    PatchGrid(PatchSize patch, int ranges, int beams)
        : size(patch), rows(ranges / patch.ranges), columns(beams / patch.beams) {}
    int places() const { return rows * columns; }
    int first_range(int place) const { return place / columns * size.ranges; }
    int first_beam(int place) const { return place % columns * size.beams; }
    /// The number of the patch that holds a bin, or that is the nearest across the beams.
    int place_of(int range, int beam) const {
        const int across = std::max(columns, 1);
        return range / size.ranges * across + std::min(across - 1, beam / size.beams);
    }
    /// Calls `visit(value, range, beam)` for the bins of a patch.
    template <class Visit>
    void for_each_bin(const ImageView& image, int place, const Visit& visit) const {
        const int range = first_range(place);
        const int beam = first_beam(place);
        for (int i = range; i < range + size.ranges; ++i) {
            for (int j = beam; j < beam + size.beams; ++j)
                visit(image.at(i, j), i, j);
        }
    }
};

}  // namespace sonarsim
