#include "dataset/measure.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "product/echogram.h"
#include "product/sidescan_row.h"
#include "product/soundings.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

Json number_or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

Json altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const Eigen::Vector3d down =
        T_world_sensor.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
    const Ray ray{Eigen::Vector3f::Zero(), down.cast<float>()};
    Intersection hit{};
    engine.intersect(T_world_sensor, {&ray, 1}, {&hit, 1});
    return std::isfinite(hit.distance_m) ? Json(hit.distance_m) : Json();
}

Measurement sidescan(const Sonar& sonar, const Ping& ping, Json altitude) {
    const FirstReturns first = first_returns(sonar, ping);
    return {bytes_of(sidescan_row(sonar.config, ping)),
            {{"altitude_m", std::move(altitude)},
             {"first_return_m",
              {{"port", number_or_null(first.port_m)},
               {"starboard", number_or_null(first.starboard_m)}}}}};
}

Measurement echosounder(const Sonar& sonar, const Ping& ping, Json altitude) {
    return {bytes_of(ping.intensity),
            {{"altitude_m", std::move(altitude)},
             {"depth_m", number_or_null(detected_depth(sonar, ping))}}};
}

Measurement profiling(const Sonar& sonar, const Pose& T_world_vehicle, const Ping& ping,
                      Json altitude) {
    std::vector<double> fields;
    int found = 0;
    for (const Sounding& s : find_soundings(sonar, T_world_vehicle, ping)) {
        fields.insert(fields.end(),
                      {s.range_m, s.position.x(), s.position.y(), s.position.z(), s.quality});
        found += !std::isnan(s.range_m);
    }
    return {bytes_of(fields), {{"altitude_m", std::move(altitude)}, {"soundings", found}}};
}

}  // namespace

Measurement measure(const Sonar& sonar, const VisibilityEngine& engine, const Pose& T_world_vehicle,
                    const Ping& ping) {
    const auto altitude = [&] {
        return altitude_m(engine, T_world_vehicle * sonar.T_vehicle_sensor);
    };
    switch (sonar.config.kind) {
        case SonarKind::imaging:
            return {};
        case SonarKind::profiling:
            return profiling(sonar, T_world_vehicle, ping, altitude());
        case SonarKind::sidescan:
            return sidescan(sonar, ping, altitude());
        case SonarKind::echosounder:
            return echosounder(sonar, ping, altitude());
    }
    return {};
}

NpyFormat record_format(const Sonar& sonar, std::size_t pings) {
    const auto bins = static_cast<std::size_t>(sonar.config.range_bins);
    switch (sonar.config.kind) {
        case SonarKind::sidescan:
            return {"<f4", {pings, static_cast<std::size_t>(waterfall_columns(sonar.config))}};
        case SonarKind::echosounder:
            return {"<f4", {bins, pings}, true};
        default:
            return {"<f8",
                    {pings, static_cast<std::size_t>(sonar.settings.view.beams), sounding_fields}};
    }
}

}  // namespace sonarsim
