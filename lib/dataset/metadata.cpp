#include "dataset/metadata.h"

#include "mission/resolved.h"
#include "sonar/kinds.h"

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

Json describe_sensor(const Sonar& sonar, const Mission& mission, const Layout& layout,
                     const SensorLayout& own, const Writers& writers) {
    const SonarConfig& config = sonar.config;
    Json json = {{"name", config.name},
                 {"kind", name_of(config.kind)},
                 {"settings", "mission.resolved.yaml#/sensors/" + config.name},
                 {"stream", sonar.settings.stream},
                 {"every", config.every},
                 {"pings", own.pings},
                 {"T_vehicle_sensor", describe_pose(sonar.T_vehicle_sensor)},
                 {"full_scale", mission.output.full_scale}};
    json["files"] = Json::object();
    for (const auto& part : own.per_ping) {
        if (const auto* file = std::get_if<PingFile>(&part)) {
            json["files"][file->name] = config.name + "/" + file->name + "/%0" +
                                        std::to_string(layout.digits) + "d" + file->extension;
        }
        if (const auto* record = std::get_if<PingRecord>(&part)) {
            json["records"] = {{"file", config.name + "/" + record->file}, {"axes", record->axes}};
        }
    }
    for (const std::string& name : own.products)
        json["products"].push_back(config.name + "/" + name);
    for (const auto& writer : writers)
        writer->describe(json);
    json["range_edges_m"] = sonar.range_edges_m;
    if (!sonar.azimuth_edges_rad.empty()) json["azimuth_edges_rad"] = sonar.azimuth_edges_rad;
    return json;
}

}  // namespace

Json describe_dataset(const Mission& mission, const Assembly& assembly, const Layout& layout,
                      const std::vector<Writers>& writers) {
    Json json = {{"format", dataset_format},
                 {"format_version", dataset_format_version},
                 {"program_version", SONARSIM_VERSION},
                 {"complete", false},
                 {"mission", mission.name},
                 {"mission_hash", mission_hash(mission, sonar_keys())},
                 {"inputs_hash", inputs_hash(assembly)},
                 {"seed", mission.seed},
                 {"poses", assembly.trajectory.size()}};
    json["scene"] = describe_scene_use(assembly.scene);
    Json sensors = Json::array();
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        sensors.push_back(
            describe_sensor(assembly.sonars[i], mission, layout, layout.sensors[i], writers[i]));
    }
    json["sensors"] = std::move(sensors);
    return json;
}

Json describe_ping(const Mission& mission, const Assembly& assembly, const FinishedPing& finished) {
    const PingId& id = finished.id;
    const PingCounts& counts = finished.ping.counts;
    const Sonar& sonar = assembly.sonars[id.sensor];
    const TimedPose& pose = assembly.trajectory[id.pose];
    const Pose T_world_sensor = sensor_pose(sonar, pose.T_world_vehicle, id.pose);
    Json json = {
        {"sensor", sonar.config.name},
        {"settings", "mission.resolved.yaml#/sensors/" + sonar.config.name},
        {"ping", id.pose},
        {"time_s", pose.t_s},
        {"T_world_vehicle", describe_pose(pose.T_world_vehicle)},
        {"T_world_sensor", describe_pose(T_world_sensor)},
        {"random", {{"seed", mission.seed}, {"stream", sonar.settings.stream}, {"ping", id.pose}}},
        {"full_scale", mission.output.full_scale},
        {"clipped_pixels", finished.clipped_pixels},
        {"counts", json_object<Json>(ping_counters, counts)}};
    json["counts"]["multipath"] = json_object<Json>(multipath_counters, counts.multipath);
    if (!finished.measured.is_null()) json["measured"] = finished.measured;
    return json;
}

std::string json_text(const Json& json) {
    // A mission's name may be any bytes; what is no UTF-8 becomes U+FFFD.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sonarsim
