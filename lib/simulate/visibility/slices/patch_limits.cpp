#include "simulate/visibility/slices/patch_limits.h"

#include <algorithm>

namespace sonarsim {

namespace {

// In range bins, at an error goal of 3 %: a quarter fewer samples of the tank than with a third.
constexpr float max_sag = 0.09F;
constexpr float shortest_patch = 0.25F;
// In range bins, at coarse goals: a third fewer samples of the tank and of a lifeboat than with 0.
constexpr float max_wedge = 1.0F;
// In range bins, at fine goals, in proportion to the goal: treads of stairs that are seen edge-on.
constexpr float max_grazing_wedge = 1.0F;
constexpr float long_patch = 2.0F;
// The energy of a flat floor in a cone is off by 0.5 % with it, by 54 % without a limit.
constexpr float widest_ratio = 1.5F;
// Error of an image per root of the share by which neighbouring slices differ, of drawn lattices.
constexpr double error_per_root = 0.22;

/// True for error goals that allow coarse patches.
bool is_coarse(double relative_l1) {
    return relative_l1 >= 0.02;
}

}  // namespace

SliceDensity slice_density(const View& view) {
    const double goal = view.relative_l1;
    const double of_shapes = 0.002 + 0.003 * std::clamp(goal / 0.03, 0.1, 1.0);
    const double root = std::max(goal - of_shapes, 0.0) / error_per_root;
    return {is_coarse(goal) ? 1 : goal >= 0.005 ? 2 : 4, std::max(root * root, 0.125 * goal)};
}

PatchLimits patch_limits(const View& view) {
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto finer = static_cast<float>(std::clamp(view.relative_l1 / 0.03, 0.1, 1.0));
    const float of_bin = finer * bin_m;
    const bool coarse = is_coarse(view.relative_l1);
    PatchLimits limits{max_sag * of_bin,
                       shortest_patch * of_bin,
                       coarse ? max_wedge * bin_m : 0.0F,
                       max_grazing_wedge * of_bin,
                       coarse ? std::numeric_limits<float>::infinity() : long_patch * bin_m,
                       static_cast<float>(view.range_max_m)};
    if (view.shape == ViewShape::cone) limits.widest_ratio = widest_ratio;
    return limits;
}

}  // namespace sonarsim
