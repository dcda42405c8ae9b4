#include "scene/seabed/sediments.h"

#include <cmath>

#include "scene/seabed/patches.h"
#include "scene/seabed/smooth_field.h"

namespace sonarsim {

std::vector<std::uint8_t> sediments_of(const BedGrid& grid, const std::vector<BedSediment>& list,
                                       double patch_m, double border_m, std::uint64_t seed) {
    std::vector<std::uint8_t> out(grid.size(), 0);
    if (list.size() < 2) return out;
    const std::vector<float> large =
        smooth_field(grid, length_of_patches(patch_m), bed_key(seed, BedDraw::sediments));
    const std::vector<float> small =
        smooth_field(grid, length_of_patches(border_m), bed_key(seed, BedDraw::borders));
    double sum = 0.0;
    for (const BedSediment& sediment : list)
        sum += sediment.share;
    std::vector<double> limits;
    double below = 0.0;
    for (const BedSediment& sediment : list) {
        below += sediment.share;
        limits.push_back(normal_quantile(below / sum));
    }
    limits.pop_back();
    constexpr double part_of_borders = 0.25;
    const double part_of_patches = std::sqrt(1.0 - part_of_borders * part_of_borders);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double value = part_of_patches * static_cast<double>(large[i]) +
                             part_of_borders * static_cast<double>(small[i]);
        for (const double limit : limits)
            out[i] = static_cast<std::uint8_t>(out[i] + (value > limit ? 1 : 0));
    }
    return out;
}

}  // namespace sonarsim
