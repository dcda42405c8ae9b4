#include "dataset/metadata.h"

#include "mission/resolved.h"
#include "product/fan.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

Json describe_pose(const Pose& pose) {
    const Eigen::Vector3d& p = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    return {{"position_m", {p.x(), p.y(), p.z()}},
            {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

/// What of the scene's files is rendered, how well it is known, and what is left out.
Json describe_scene_use(const Scene& scene) {
    return {{"triangles", scene.triangles.size()},
            {"vertex_rounding_m", scene.vertex_rounding_m},
            {"dropped",
             {{"degenerate_triangles", scene.rejects.degenerate_triangles},
              {"non_finite_triangles", scene.rejects.non_finite_triangles},
              {"skipped_primitives", scene.rejects.skipped_primitives}}}};
}

/// How the axes of a sensor's records run, in the order of the indices.
Json record_axes(SonarKind kind) {
    switch (kind) {
        case SonarKind::sidescan:
            return {"ping", "port from range_max to nadir, then starboard from nadir to range_max"};
        case SonarKind::echosounder:
            return {"range", "ping"};
        default:
            return {"ping", "beam", "range_m, x_m, y_m, z_m, quality"};
    }
}

Json describe_sensor(const Sonar& sonar, const Mission& mission, const Layout& layout,
                     const SensorLayout& own) {
    const SonarConfig& config = sonar.config;
    Json json = {{"name", config.name},
                 {"kind", name_of(config.kind)},
                 {"settings", "mission.resolved.yaml#/sensors/" + config.name},
                 {"stream", sonar.settings.stream},
                 {"every", config.every},
                 {"pings", own.pings},
                 {"T_vehicle_sensor", describe_pose(sonar.T_vehicle_sensor)},
                 {"full_scale", mission.output.full_scale}};
    Json files = Json::object();
    for (const FileKind kind : own.kinds) {
        files[std::string(name_of(kind))] = config.name + "/" + std::string(name_of(kind)) + "/%0" +
                                            std::to_string(layout.digits) + "d" +
                                            std::string(extension_of(kind));
    }
    json["files"] = std::move(files);
    if (!own.series.record.empty()) {
        Json products = Json::array();
        for (const std::string& name : own.series.products)
            products.push_back(config.name + "/" + name);
        json["records"] = {{"file", config.name + "/" + own.series.record},
                           {"axes", record_axes(config.kind)}};
        json["products"] = std::move(products);
    }
    if (own.writes(FileKind::fan)) {
        const FanFrame fan = fan_frame(sonar, mission.output.fan_width_px);
        json["fan"] = {{"width_px", fan.width},
                       {"height_px", fan.height},
                       {"pixel_m", fan.pixel_m},
                       {"apex_px", {0.5 * fan.width, config.range_max_m / fan.pixel_m}}};
    }
    if (config.kind == SonarKind::sidescan) {
        json["waterfall"] = {{"columns", waterfall_columns(config)},
                             {"blank_columns_a_side", blank_columns(config)},
                             {"column_m", sonar.settings.view.bin_m()},
                             {"slant_range",
                              "of the middle of column k: |k + 0.5 - columns / 2| "
                              "column_m; blank columns lie before range_min"}};
    }
    json["range_edges_m"] = sonar.range_edges_m;
    if (!sonar.azimuth_edges_rad.empty()) json["azimuth_edges_rad"] = sonar.azimuth_edges_rad;
    return json;
}

}  // namespace

Json describe_dataset(const Mission& mission, const Assembly& assembly, const Layout& layout) {
    Json json = {{"format", dataset_format},
                 {"format_version", dataset_format_version},
                 {"program_version", SONARSIM_VERSION},
                 {"complete", false},
                 {"mission", mission.name},
                 {"mission_hash", mission_hash(mission)},
                 {"inputs_hash", inputs_hash(assembly)},
                 {"seed", mission.seed},
                 {"poses", assembly.trajectory.size()}};
    json["scene"] = describe_scene_use(assembly.scene);
    Json sensors = Json::array();
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        sensors.push_back(describe_sensor(assembly.sonars[i], mission, layout, layout.sensors[i]));
    }
    json["sensors"] = std::move(sensors);
    return json;
}

Json describe_ping(const Mission& mission, const Assembly& assembly, const PingId& id,
                   const PingCounts& counts, std::uint64_t clipped_pixels, const Json& measured) {
    const Sonar& sonar = assembly.sonars[id.sensor];
    const TimedPose& pose = assembly.trajectory[id.pose];
    const Pose T_world_sensor = pose.T_world_vehicle * sonar.T_vehicle_sensor;
    Json json = {
        {"sensor", sonar.config.name},
        {"settings", "mission.resolved.yaml#/sensors/" + sonar.config.name},
        {"ping", id.pose},
        {"time_s", pose.t_s},
        {"T_world_vehicle", describe_pose(pose.T_world_vehicle)},
        {"T_world_sensor", describe_pose(T_world_sensor)},
        {"random", {{"seed", mission.seed}, {"stream", sonar.settings.stream}, {"ping", id.pose}}},
        {"full_scale", mission.output.full_scale},
        {"clipped_pixels", clipped_pixels},
        {"counts", json_object<Json>(ping_counters, counts)}};
    json["counts"]["multipath"] = json_object<Json>(multipath_counters, counts.multipath);
    if (!measured.is_null()) json["measured"] = measured;
    return json;
}

std::string json_text(const Json& json) {
    // A mission's name may be any bytes; what is no UTF-8 becomes U+FFFD.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sonarsim
