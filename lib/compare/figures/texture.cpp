#include "compare/figures/texture.h"

#include <bit>
#include <cstdint>

namespace sonarsim {

namespace {

/// The place of each of 256 patterns in the histogram.
std::array<int, 256> places_of_patterns() {
    std::array<int, 256> places{};
    int next = 0;
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const auto turned = static_cast<std::uint8_t>(pattern << 1 | pattern >> 7);
        const int changes = std::popcount(static_cast<std::uint8_t>(pattern ^ turned));
        places[pattern] = changes <= 2 ? next++ : texture_patterns - 1;
    }
    return places;
}

}  // namespace

std::array<double, texture_patterns> texture_histogram(const ImageView& image,
                                                       const PatchGrid& grid, int place) {
    const std::array<int, 256> places = places_of_patterns();
    // The neighbours around the circle.
    constexpr std::array<std::array<int, 2>, 8> neighbours{
        {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}}};
    std::array<double, texture_patterns> histogram{};
    const int range = grid.first_range(place);
    const int beam = grid.first_beam(place);
    for (int i = range + 1; i + 1 < range + grid.size.ranges; ++i) {
        for (int j = beam + 1; j + 1 < beam + grid.size.beams; ++j) {
            const float middle = image.at(i, j);
            unsigned pattern = 0;
            for (const auto& [down, right] : neighbours)
                pattern = pattern << 1 | (image.at(i + down, j + right) >= middle ? 1U : 0U);
            histogram[static_cast<std::size_t>(places[pattern])] += 1.0;
        }
    }
    return histogram;
}

}  // namespace sonarsim
