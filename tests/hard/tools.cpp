#include "hard/cases.h"
#include "simulate/reference/reference.h"
#include "support/sonars.h"

namespace sonarsim {

namespace {

HardTrial at(SonarKind kind, const ConfigChange& change, const Eigen::Vector3d& position,
             double pitch_deg, double yaw_deg) {
    SonarConfig config = default_sonar(kind);
    config.name = name_of(kind);
    set_range(config, 0.2, 10.0, 128);
    config.azimuth_bins = 48;
    if (kind == SonarKind::imaging) config.azimuth_deg = 60.0;
    config.sector_deg = config.step_deg = 0.01;  // the head of a scanning sonar looks ahead
    if (kind == SonarKind::sidescan) config.elevation_deg = 0.5;
    // A narrow cone over a floor fills two bins, and one bin more or less would dominate the error.
    config.opening_deg = 90.0;
    if (change) change(config);
    return {noise_free(config),
            {rotation_from_rpy(0.0, radians(pitch_deg), radians(yaw_deg)), position}};
}

}  // namespace

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

HardTrial HardCase::trial(SonarKind kind) const {
    HardTrial out = starts_in_tank ? in_tank(kind, change) : over_floor(kind, change);
    if (move) move(kind, out.T_world_vehicle);
    return out;
}

HardTrial with_model(HardTrial trial, ModelKind model) {
    if (model == trial.sonar.config.model) return trial;
    SonarConfig config = trial.sonar.config;
    config.model = model;
    config.instrument.receiver.noise_db = -200.0;
    config.instrument.speckle.texture = 0.0;  // a field of the world, which these cases move
    config.instrument.receiver.full_scale_db = -20.0;
    config.instrument.receiver.companding = Companding::linear;
    config.instrument.receiver.bits = 16;
    trial.sonar = make_sonar(config, {});
    return trial;
}

Scene plain_floor() {
    return floor_scene(30.0F, 0.0F, 0.5F);
}

std::vector<float> plane_law(const HardContext& context, double reflection, double height_m) {
    const Ping& ping = context.ping;
    const std::vector<double>& edges = context.trial.sonar.range_edges_m;
    std::vector<float> truth(ping.intensity.size(), unchecked);
    for (int j = 0; j < ping.beams; ++j) {
        for (int i = 1; i + 1 < ping.range_bins; ++i) {
            if (!(ping.at(i - 1, j) > 0.0F && ping.at(i, j) > 0.0F && ping.at(i + 1, j) > 0.0F))
                continue;
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
    const Pose T_world_sensor = sensor_pose(context.trial.sonar, context.trial.T_world_vehicle, 0);
    return cast_reference(Caster(context.scene), context.scene, context.trial.sonar.settings.view,
                          T_world_sensor, {0.002, 64.0, 2'000'000})
        .intensity;
}

std::vector<float> image_of(const Scene& scene, const HardTrial& trial, EngineKind engine_kind,
                            ModelKind model) {
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(scene, engine_settings(engine_kind));
    return render_ping(with_model(trial, model).sonar, scene, *engine, trial.T_world_vehicle,
                       {1, 0}, model == ModelKind::paper ? Terms{} : without_random_terms)
        .intensity;
}

std::vector<float> tank_image(const HardContext& context) {
    return image_of(tank(), in_tank(context.kind), context.engine, context.model);
}

}  // namespace sonarsim
