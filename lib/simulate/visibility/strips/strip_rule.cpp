#include <algorithm>
#include <limits>

#include "simulate/visibility/strips/strip_samples.h"

namespace sonarsim {

namespace {

constexpr double usual_goal = 0.03;
constexpr double finest_goal = 0.003;

// Thin things need more columns, in proportion, up to this many times as many.
constexpr float by_thinness = 1.3F;
constexpr float max_by_thinness = 4.0F;

// Views of energies that are thinner than this have at least two parts; fitted to a wreck.
constexpr float thin_view = 0.28F;

// Columns of a side where energies add: the beam receives most from its middle.
constexpr float side_columns = 13.0F;

// An energy is weighed by the beam pattern at the middle of its sample. A sample of a fan or a cone
// spans at most this share of the view along its column, one of a side at most this angle.
constexpr double samples_along = 32.0;
constexpr double side_along_rad = 0.0125;

// Wedges of energies are shorter than the pieces of labels. 16 bins leave holes in shadows.
constexpr float wedge_of_energies = 7.0F;

}  // namespace

StripRule strip_rule(const View& view) {
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto finer =
        static_cast<float>(std::clamp(view.relative_l1, finest_goal, usual_goal) / usual_goal);
    StripRule rule{};
    rule.columns = 1.0F / finer;
    if (view.energies_add && view.shape == ViewShape::port_starboard) rule.columns *= side_columns;
    rule.energies_add = view.energies_add;
    rule.bin_m = bin_m;
    rule.range_max_m = static_cast<float>(view.range_max_m);
    rule.sag_m = 0.09F * finer * bin_m;
    rule.wedge_m = finer * bin_m;
    rule.taper = 0.35F;
    rule.along_rad = std::numeric_limits<float>::max();
    if (view.energies_add) {
        // Energies follow the trapezoids of samples; a mean of a bin takes parallelograms.
        rule.wedge_m = wedge_of_energies * std::max(finer, 0.5F) * bin_m;
        rule.taper = 1.0F;  // any
        rule.along_rad = static_cast<float>(view.shape == ViewShape::port_starboard
                                                ? side_along_rad
                                                : view.elevation_rad / samples_along);
    }
    return rule;
}

int column_parts(const StripRule& rule, float thinness) {
    constexpr float rounding = 1e-3F;
    const float least = rule.energies_add && thinness > thin_view ? 2.0F : 1.0F;
    const float parts = rule.columns * std::min(1.0F + by_thinness * thinness, max_by_thinness);
    return static_cast<int>(std::max(parts, least) + rounding);
}

}  // namespace sonarsim
