#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "core/input_limits.h"
#include "mission/limits.h"
#include "mission/mission.h"
#include "mission/sonar_keys.h"

// The keys of a mission, each written once. A visitor is handed every key with its value, its
// limits and its checks; the MissionReader fills the value from YAML, the MissionWriter turns it
// into YAML.

namespace sonarsim {

inline constexpr std::array multipath_methods{
    Choice<MultipathMethod>{"none", MultipathMethod::none},
    Choice<MultipathMethod>{"cluster", MultipathMethod::cluster},
    Choice<MultipathMethod>{"exact", MultipathMethod::exact}};
inline constexpr std::array streak_modes{Choice<StreakMode>{"none", StreakMode::none},
                                         Choice<StreakMode>{"add", StreakMode::add},
                                         Choice<StreakMode>{"reduce", StreakMode::reduce}};
inline constexpr std::array engine_kinds{Choice<EngineKind>{"auto", EngineKind::automatic},
                                         Choice<EngineKind>{"rays", EngineKind::rays},
                                         Choice<EngineKind>{"octree", EngineKind::octree}};

/// Fit for the name of a folder that holds nothing but one mission.
inline bool is_folder_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.size() <= 200 &&
           name.find('/') == std::string_view::npos;
}

template <class Visitor>
void describe(Visitor& v, WaterConfig& c) {
    v.number("density_kg_m3", c.density_kg_m3, between(least_medium, largest_medium));
    v.number("sound_speed_m_s", c.sound_speed_m_s, between(least_medium, largest_medium));
}

template <class Visitor>
void describe(Visitor& v, SceneConfig& c) {
    v.path("file", c.file, required);
    v.path("materials", c.materials, required);
}

template <class Visitor>
void describe(Visitor& v, MountConfig& c) {
    v.numbers("translation_m", c.translation_m, any_position_m);
    v.numbers("rpy_deg", c.rpy_deg, any_angle_deg);
}

template <class Visitor>
void describe(Visitor& v, NoiseConfig& c) {
    v.number("range_lambda_m", c.range_lambda_m, at_least(0));
    // Cells are counted from the world's origin: below a tenth of a millimetre the counts of
    // UTM-sized coordinates leave what a double holds exactly.
    v.number("scatterer_m", c.scatterer_m, between(1e-4, 1e3));
    v.number("add_sigma", c.add_sigma, at_least(0));
    v.number("mult_sigma", c.mult_sigma, at_least(0));
    v.flag("scale_with_range", c.scale_with_range);
    v.number("lobe_sigma_deg", c.lobe_sigma_deg, between(0, 360));
}

template <class Visitor>
void describe(Visitor& v, MultipathConfig& c) {
    v.choice("method", c.method, multipath_methods);
    v.integer("epsilon_bins", c.epsilon_bins, between(0, 8192));
    v.number("delta_deg", c.delta_deg, between(0, 180));
}

template <class Visitor>
void describe(Visitor& v, StreaksConfig& c) {
    v.choice("mode", c.mode, streak_modes);
    v.number("threshold", c.threshold, between(0, 1));
    v.number("angle_deg", c.angle_deg, between(0, 90));
}

template <class Visitor>
void describe(Visitor& v, SonarConfig& c) {
    const SonarKeys& keys = v.sonar_kind("kind", c);
    v.section("mount", c.mount);
    v.integer("every", c.every, at_least(1));
    if (keys.opening) v.number("opening_deg", c.opening_deg, between(1e-3, 180));
    if (keys.azimuth) v.number("azimuth_deg", c.azimuth_deg, between(1e-3, 360));
    if (keys.elevation) v.number("elevation_deg", c.elevation_deg, between(1e-3, 180));
    if (keys.head) v.number("sector_deg", c.sector_deg, between(1e-2, 360));
    if (keys.head) v.number("step_deg", c.step_deg, between(1e-2, 360));
    v.require(!keys.head || c.step_deg <= c.sector_deg, {"sector_deg", "step_deg"},
              "step_deg must be at most sector_deg");
    v.number("range_min_m", c.range_min_m, at_least(0));
    v.number("range_max_m", c.range_max_m, above(0));
    // 8192 x 8192 bins are 2^26, the largest image that is rendered.
    v.integer("range_bins", c.range_bins, between(1, 8192));
    if (keys.azimuth_bins) v.integer("azimuth_bins", c.azimuth_bins, between(1, 8192));
    v.section("multipath", c.multipath);
    v.section("noise", c.noise);
    v.section("streaks", c.streaks);
    v.require(keys.range_noise || c.noise.range_lambda_m == 0.0, {"noise"},
              "this kind of sonar has no range noise: range_lambda_m must be 0");
    v.require(c.range_min_m < c.range_max_m, {"range_min_m", "range_max_m"},
              "range_min_m must be below range_max_m");
    v.require((c.range_max_m - c.range_min_m) / c.range_bins > 1e-6,
              {"range_min_m", "range_max_m", "range_bins"},
              "range bins must be wider than a micrometre");
}

template <class Visitor>
void describe(Visitor& v, FileTrajectoryConfig& c) {
    v.path("file", c.file, required);
    v.number("rate_hz", c.rate_hz, at_least(0));
}

template <class Visitor>
void describe(Visitor& v, WaypointConfig& c) {
    v.numbers("position_m", c.position_m, any_position_m, required);
    v.numbers("rpy_deg", c.rpy_deg, any_angle_deg);
}

template <class Visitor>
void describe(Visitor& v, WaypointTrajectoryConfig& c) {
    v.list("waypoints", c.waypoints, 2);
    v.number("speed_m_s", c.speed_m_s, above(0));
    v.number("rate_hz", c.rate_hz, above(0));
}

template <class Visitor>
void describe(Visitor& v, LawnmowerTrajectoryConfig& c) {
    v.numbers("area_min_m", c.area_min_m, any_position_m, required);
    v.numbers("area_max_m", c.area_max_m, any_position_m, required);
    v.number("z_m", c.z_m, any_position_m, required);
    v.number("heading_deg", c.heading_deg, any_angle_deg);
    v.number("line_spacing_m", c.line_spacing_m, above(0));
    v.number("speed_m_s", c.speed_m_s, above(0));
    v.number("rate_hz", c.rate_hz, above(0));
    v.require(c.area_min_m[0] < c.area_max_m[0] && c.area_min_m[1] < c.area_max_m[1],
              {"area_min_m", "area_max_m"}, "area_min_m must be below area_max_m in x and in y");
}

template <class Visitor>
void describe(Visitor& v, TrajectoryConfig& c) {
    v.one_of(c, {"file", "waypoints", "lawnmower"});
    if (auto* lawnmower = std::get_if<LawnmowerTrajectoryConfig>(&c)) {
        v.section("lawnmower", *lawnmower, required);
    } else {
        std::visit([&v](auto& form) { describe(v, form); }, c);
    }
}

template <class Visitor>
void describe(Visitor& v, AccuracyConfig& c) {
    v.number("relative_l1", c.relative_l1, between(1e-4, 0.5));
}

template <class Visitor>
void describe(Visitor& v, OctreeConfig& c) {
    // Leaves below a millimetre are finer than any sonar's bins.
    v.number_or_auto("leaf_m", c.leaf_m, between(1e-3, 1e3));
    v.integer("memory_mb", c.memory_mb, between(1, 1e6));
    v.flag("literal", c.literal);
}

template <class Visitor>
void describe(Visitor& v, OutputConfig& c) {
    v.path("folder", c.folder);
    v.flag("polar", c.polar);
    v.flag("image", c.image);
    v.flag("fan", c.fan);
    v.flag("meta", c.meta);
    v.flag("stages", c.stages);
    v.integer("fan_width_px", c.fan_width_px, between(0, 8192));
    v.number("full_scale", c.full_scale, above(0));
    v.flag("waterfall", c.waterfall);
    v.flag("echogram", c.echogram);
    v.flag("soundings", c.soundings);
    v.flag("scan", c.scan);
    v.number("bathymetry_cell_m", c.bathymetry_cell_m, at_least(0));
}

template <class Visitor>
void describe(Visitor& v, Mission& c) {
    v.text("name", c.name);
    v.require(is_folder_name(c.name), {"name"},
              "'name' names a folder: at most 200 bytes, without '/'");
    v.integer("seed", c.seed);
    v.section("water", c.water);
    v.section("scene", c.scene, required);
    v.section("trajectory", c.trajectory, required);
    v.named("sensors", c.sensors);
    v.section("accuracy", c.accuracy);
    v.choice("engine", c.engine, engine_kinds);
    v.section("octree", c.octree);
    v.section("output", c.output);
}

}  // namespace sonarsim
