#include "benchmark/ladder.h"

#include <algorithm>
#include <limits>

#include "core/text.h"

namespace sonarsim {

namespace {

Setting rays_with(double goal) {
    return {"rays", "relative_l1=" + number_text(goal), EngineKind::rays, {}, goal, false};
}

/// `leaf_m` 0 is auto.
Setting octree_with(double leaf_m, bool literal, const Mission& mission) {
    OctreeConfig octree = mission.octree;
    octree.leaf_m = leaf_m;
    octree.literal = literal;
    return {literal ? "literal" : "octree",
            "leaf_m=" + (leaf_m > 0.0 ? number_text(leaf_m) : std::string("auto")),
            EngineKind::octree,
            octree,
            mission.accuracy.relative_l1,
            false};
}

Setting own_setting(const Mission& mission) {
    return mission.engine == EngineKind::octree
               ? octree_with(mission.octree.leaf_m, mission.octree.literal, mission)
               : rays_with(mission.accuracy.relative_l1);
}

double finest_bin_m(const Mission& mission) {
    double finest = std::numeric_limits<double>::infinity();
    for (const SonarConfig& sensor : mission.sensors) {
        finest = std::min(finest, (sensor.range_max_m - sensor.range_min_m) / sensor.range_bins);
    }
    return finest;
}

}  // namespace

std::vector<Setting> make_ladder(const Mission& mission, bool quick) {
    const std::vector<double> goals =
        quick ? std::vector{0.1, 0.03, 0.01} : std::vector{0.3, 0.1, 0.06, 0.03, 0.01, 0.003};
    const std::vector<double> leaves =
        quick ? std::vector{0.08, 0.04} : std::vector{0.08, 0.04, 0.02, 0.01};
    std::vector<Setting> ladder;
    ladder.reserve(2 * leaves.size() + goals.size() + 2);
    for (const double goal : goals)
        ladder.push_back(rays_with(goal));
    for (const bool literal : {true, false}) {
        for (const double leaf : leaves) {
            if (leaf >= 0.25 * finest_bin_m(mission)) {
                ladder.push_back(octree_with(leaf, literal, mission));
            }
        }
    }
    ladder.push_back(octree_with(0.0, false, mission));
    Setting own = own_setting(mission);
    own.current = true;
    const auto same = std::ranges::find_if(ladder, [&](const Setting& setting) {
        return setting.engine == own.engine && setting.name == own.name;
    });
    if (same == ladder.end()) {
        ladder.push_back(own);
    } else {
        *same = own;
    }
    return ladder;
}

}  // namespace sonarsim
