#include "simulate/sonar/measured.h"

#include <cmath>

#include "simulate/sonar/setup.h"

namespace sonarsim {

std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const Eigen::Vector3d down =
        T_world_sensor.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
    const Ray ray{Eigen::Vector3f::Zero(), down.cast<float>()};
    Intersection bottom{};
    engine.intersect(T_world_sensor, {&ray, 1}, {&bottom, 1});
    if (!std::isfinite(bottom.distance_m)) return std::nullopt;
    return bottom.distance_m;
}

nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine) {
    const KindOfSonar& kind = kind_of(view.sonar.config.kind);
    if (!kind.measure) return {};
    const Pose T_world_sensor = sensor_pose(view.sonar, view.T_world_vehicle, view.pose);
    nlohmann::ordered_json json = {
        {"altitude_m", number_or_null(altitude_m(engine, T_world_sensor))}};
    kind.measure(view, json);
    return json;
}

}  // namespace sonarsim
