#include "run/report/settings.h"

#include <algorithm>
#include <limits>

#include "core/text.h"
#include "simulate/assembly/engines.h"
#include "simulate/sonar/engine_settings.h"

namespace sonarsim {

namespace {

Setting setting_of(EngineKind kind, double goal, const OctreeConfig& octree = {}) {
    const bool is_octree = kind == EngineKind::octree;
    return {.engine = std::ranges::find(engine_names, kind, &Choice<EngineKind>::value)->name,
            .name = is_octree ? "leaf_m=" + number_text(octree.leaf_m)
                              : "relative_l1=" + number_text(goal),
            .kind = kind,
            .octree = is_octree ? octree : OctreeConfig{},
            .relative_l1 = goal};
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
    const double own_goal = mission.accuracy.relative_l1;
    std::vector<Setting> settings;
    for (const double goal : goals)
        settings.push_back(setting_of(EngineKind::rays, goal));
    for (const double goal : goals)
        settings.push_back(setting_of(EngineKind::strips, goal));
    for (const double leaf : leaves) {
        if (leaf >= 0.25 * finest_bin_m(mission))
            settings.push_back(setting_of(EngineKind::octree, own_goal, {leaf}));
    }
    settings.push_back(setting_of(EngineKind::automatic, own_goal));
    Setting own = setting_of(mission.engine, own_goal, mission.octree);
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
