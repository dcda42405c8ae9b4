#include "simulate/visibility/strips/strip_rule.h"

#include <algorithm>
#include <cstdlib>

namespace sonarsim {

namespace {

constexpr double usual_goal = 0.03;
constexpr double finest_goal = 0.003;

// Thin things need more columns, in proportion, but not more than this many times.
constexpr float most_by_thinness = 4.0F;

}  // namespace

StripRule strip_rule(const View& view) {
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto finer =
        static_cast<float>(std::clamp(view.relative_l1, finest_goal, usual_goal) / usual_goal);
    StripRule rule{};
    rule.columns = 1.0F / finer;
    rule.bin_m = bin_m;
    rule.range_min_m = static_cast<float>(view.range_min_m);
    rule.range_max_m = static_cast<float>(view.range_max_m);
    rule.small_m = finer * bin_m;
    rule.sag_m = 0.09F * finer * bin_m;
    rule.wedge_m = std::max(finer, 0.5F) * bin_m;
    rule.taper = 0.35F;
    return rule;
}

int column_parts(const StripRule& rule, float thinness) {
    if (const char* t = std::getenv("ST_C")) return std::atoi(t);
    return static_cast<int>(rule.columns * std::clamp(thinness + 1.0F, 1.0F, most_by_thinness) + 0.001F);
}

}  // namespace sonarsim
