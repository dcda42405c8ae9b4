#include "hard/tools.h"

#include <memory>

#include "core/units.h"
#include "sonar/engine_settings.h"
#include "sonar/kinds.h"
#include "support/shapes.h"
#include "validation/reference.h"

namespace sonarsim {

namespace {

HardTrial at(SonarKind kind, const ConfigChange& change, const Eigen::Vector3d& position,
             double pitch_deg, double yaw_deg) {
    SonarConfig config = hard_sonar(kind);
    if (change) change(config);
    return {without_gain(config),
            {rotation_from_rpy(0.0, radians(pitch_deg), radians(yaw_deg)), position}};
}

}  // namespace

SonarConfig hard_sonar(SonarKind kind) {
    SonarConfig config = default_sonar(kind);
    config.name = name_of(kind);
    config.range_min_m = 0.2;
    config.range_max_m = 10.0;
    config.range_bins = 128;
    config.azimuth_bins = 48;
    if (kind == SonarKind::imaging) config.azimuth_deg = 60.0;
    config.sector_deg = config.step_deg = 0.01;  // the head of a scanning sonar looks ahead
    if (kind == SonarKind::sidescan) config.elevation_deg = 0.5;
    // A narrow cone over a floor fills two bins, and one bin more or less would dominate the error.
    config.opening_deg = 90.0;
    return config;
}

Sonar without_gain(const SonarConfig& config) {
    SonarConfig with_gain_1 = config;
    with_gain_1.noise.gain = 1.0;
    return make_sonar(with_gain_1, {});
}

bool looks_forward(SonarKind kind) {
    return !kind_of(kind).looks_down;
}

HardTrial over_floor(SonarKind kind, const ConfigChange& change) {
    return at(kind, change, {0.31, 0.17, 3.0}, looks_forward(kind) ? 30.0 : 0.0, 10.0);
}

HardTrial in_tank(SonarKind kind, const ConfigChange& change) {
    return at(kind, change, {looks_forward(kind) ? -2.4 : 1.7, -0.4, 1.5},
              looks_forward(kind) ? 15.0 : 0.0, 4.0);
}

HardTrial plain_sonar_over_floor(SonarKind kind) {
    return over_floor(kind);
}

HardTrial plain_sonar_in_tank(SonarKind kind) {
    return in_tank(kind);
}

Scene moved_tank(const Eigen::Vector3d& by) {
    Scene scene = shapes::tank();
    scene.origin = 10.0 * (by / 10.0).array().round().matrix();
    for (Eigen::Vector3f& p : scene.vertices)
        p = (p.cast<double>() + by - scene.origin).cast<float>();
    return scene;
}

HardTrial in_moved_tank(SonarKind kind, const Eigen::Vector3d& by) {
    HardTrial trial = in_tank(kind);
    trial.T_world_vehicle.translation += by;
    return trial;
}

Scene scaled_tank(double scale) {
    Scene scene = shapes::tank();
    for (Eigen::Vector3f& p : scene.vertices)
        p = (scale * p.cast<double>()).cast<float>();
    return scene;
}

HardTrial in_scaled_tank(SonarKind kind, double scale) {
    HardTrial trial = in_tank(kind, [&](SonarConfig& c) {
        c.range_min_m *= scale;
        c.range_max_m *= scale;
    });
    trial.T_world_vehicle.translation *= scale;
    return trial;
}

Scene plain_floor() {
    Scene scene = shapes::empty_scene();
    shapes::add_floor(scene, 30.0F, 0.0F, shapes::add_material(scene, 0.5F));
    return scene;
}

std::vector<float> plane_law(const HardContext& context, double reflection, double height_m) {
    const Ping& ping = context.ping;
    const std::vector<double>& edges = context.trial.sonar.range_edges_m;
    std::vector<float> truth(ping.intensity.size(), unchecked);
    for (int j = 0; j < ping.beams; ++j) {
        for (int i = 1; i + 1 < ping.range_bins; ++i) {
            if (!(ping.at(i - 1, j) > 0.0F && ping.at(i, j) > 0.0F && ping.at(i + 1, j) > 0.0F)) {
                continue;
            }
            const double middle = 0.5 * (edges[i] + edges[i + 1]);
            truth[static_cast<std::size_t>(i) * ping.beams + j] =
                static_cast<float>(reflection * height_m / middle);
        }
    }
    return truth;
}

std::vector<float> floor_law(const HardContext& context) {
    return plane_law(context, 0.5, 3.0);
}

std::vector<float> settled_reference(const HardContext& context) {
    const Caster caster(context.scene);
    const Pose T_world_sensor = sensor_pose(context.trial.sonar, context.trial.T_world_vehicle, 0);
    return cast_reference(caster, context.scene, context.trial.sonar.settings.view, T_world_sensor,
                          {0.002, 64.0, 2'000'000})
        .intensity;
}

std::vector<float> dark(const HardContext& context) {
    return std::vector<float>(context.ping.intensity.size(), 0.0F);
}

std::vector<float> image_of(const Scene& scene, const HardTrial& trial, EngineKind engine_kind,
                            ModelKind model) {
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(scene, engine_settings(engine_kind));
    return render_ping(with_model(trial, model).sonar, scene, *engine, trial.T_world_vehicle,
                       {1, 0}, compared_terms(model))
        .intensity;
}

}  // namespace sonarsim
