#include "run/report/settings.h"

#include <algorithm>
#include <limits>

#include "core/text.h"
#include "simulate/assembly/engines.h"
#include "simulate/sonar/engine_settings.h"

namespace sonarsim {

namespace {

/// Rays, strips or auto by error goal.
Setting with_goal(EngineKind kind, const char* engine, double goal) {
    return {.engine = engine,
            .name = "relative_l1=" + number_text(goal),
            .kind = kind,
            .octree = {},
            .relative_l1 = goal};
}

Setting octree_with(double leaf_m, double goal) {
    return {.engine = "octree",
            .name = "leaf_m=" + number_text(leaf_m),
            .kind = EngineKind::octree,
            .octree = {leaf_m},
            .relative_l1 = goal};
}

Setting own_setting(const Mission& mission) {
    const double goal = mission.accuracy.relative_l1;
    if (mission.engine == EngineKind::octree) return octree_with(mission.octree.leaf_m, goal);
    if (mission.engine == EngineKind::rays) return with_goal(EngineKind::rays, "rays", goal);
    if (mission.engine == EngineKind::automatic)
        return with_goal(EngineKind::automatic, "auto", goal);
    return with_goal(EngineKind::strips, "strips", goal);
}

double finest_bin_m(const Mission& mission) {
    double finest = std::numeric_limits<double>::infinity();
    for (const SonarConfig& sensor : mission.sensors) {
        finest = std::min(finest, (sensor.range_max_m - sensor.range_min_m) / sensor.range_bins);
    }
    return finest;
}

}  // namespace

std::vector<Setting> make_settings(const Mission& mission, bool quick) {
    const std::vector<double> goals =
        quick ? std::vector{0.1, 0.03, 0.01} : std::vector{0.1, 0.03, 0.01, 0.003};
    const std::vector<double> leaves =
        quick ? std::vector{0.08, 0.04} : std::vector{0.08, 0.04, 0.02, 0.01};
    std::vector<Setting> settings;
    settings.reserve(3 * goals.size() + leaves.size() + 2);
    for (const double goal : goals)
        settings.push_back(with_goal(EngineKind::rays, "rays", goal));
    for (const double goal : goals)
        settings.push_back(with_goal(EngineKind::strips, "strips", goal));
    for (const double leaf : leaves) {
        if (leaf >= 0.25 * finest_bin_m(mission))
            settings.push_back(octree_with(leaf, mission.accuracy.relative_l1));
    }
    settings.push_back(with_goal(EngineKind::automatic, "auto", mission.accuracy.relative_l1));
    Setting own = own_setting(mission);
    own.current = true;
    std::erase_if(settings, [&](const Setting& setting) {
        return setting.engine == own.engine && setting.name == own.name;
    });
    settings.push_back(own);
    return settings;
}

std::string unsupported(const Setting& setting, const Assembly& assembly) {
    const EngineSettings engine = engine_settings(setting.kind, setting.octree);
    std::string refusal = unsupported(engine, assembly.scene);
    for (const Sonar& sonar : assembly.sonars) {
        if (refusal.empty()) refusal = unsupported(engine, sonar.settings.view);
    }
    return refusal;
}

}  // namespace sonarsim
