#include "dataset/measured.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "product/echogram.h"
#include "product/sidescan_row.h"
#include "product/soundings.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

Json altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const Eigen::Vector3d down =
        T_world_sensor.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
    const Ray ray{Eigen::Vector3f::Zero(), down.cast<float>()};
    Intersection bottom{};
    engine.intersect(T_world_sensor, {&ray, 1}, {&bottom, 1});
    return std::isfinite(bottom.distance_m) ? Json(bottom.distance_m) : Json();
}

Json first_returns_of(const Sonar& sonar, const Ping& ping) {
    const FirstReturns first = first_returns(sonar, ping);
    return {{"port", number_or_null(first.port_m)},
            {"starboard", number_or_null(first.starboard_m)}};
}

std::size_t count_soundings(const Sonar& sonar, const Pose& T_world_vehicle, const Ping& ping) {
    return std::ranges::count_if(find_soundings(sonar, T_world_vehicle, ping),
                                 [](const Sounding& s) { return !std::isnan(s.range_m); });
}

}  // namespace

Json measured(const Sonar& sonar, const VisibilityEngine& engine, const Pose& T_world_vehicle,
              const Ping& ping) {
    if (sonar.config.kind == SonarKind::imaging) return {};
    Json json = {{"altitude_m", altitude_m(engine, T_world_vehicle * sonar.T_vehicle_sensor)}};
    switch (sonar.config.kind) {
        case SonarKind::imaging:
            break;
        case SonarKind::profiling:
            json["soundings"] = count_soundings(sonar, T_world_vehicle, ping);
            break;
        case SonarKind::sidescan:
            json["first_return_m"] = first_returns_of(sonar, ping);
            break;
        case SonarKind::echosounder:
            json["depth_m"] = number_or_null(detected_depth(sonar, ping));
            break;
    }
    return json;
}

}  // namespace sonarsim
