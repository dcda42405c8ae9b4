#include "core/text.h"
#include "input/mission/ping_draws.h"
#include "output/dataset/writer.h"

namespace sonarsim {

Json describe_drawn(const DrawnValues& drawn) {
    Json json = Json::object();
    for (const auto& [key, value] : drawn) {
        const Json parsed = Json::parse(value, nullptr, false);
        const auto number = parse_number(value);  // .5 is no JSON
        json[key] = !parsed.is_discarded() ? parsed : number ? Json(*number) : Json(value);
    }
    return json;
}

void describe_variant(const Mission& mission, Json& json) {
    if (mission.variant.index < 0) return;
    json["variant"] = {{"index", mission.variant.index},
                       {"drawn", describe_drawn(mission.variant.drawn)}};
}

Json describe_ping(const Mission& mission, const Assembly& assembly, const FinishedPing& finished) {
    const PingId& id = finished.id;
    const PingCounts& counts = finished.ping.counts;
    const Sonar& sonar = finished.sonar;
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
        {"full_scale", assembly.full_scales[id.sensor]},
        {"clipped_pixels", finished.clipped_pixels},
        {"counts", json_object<Json>(ping_counters, counts)}};
    if (!assembly.reported.empty())
        json["T_world_vehicle_reported"] =
            describe_pose(assembly.reported[id.pose].T_world_vehicle);
    json["counts"]["multipath"] = json_object<Json>(multipath_counters, counts.multipath);
    describe_variant(mission, json);
    const DrawnValues drawn = drawn_for_ping(mission, sonar.config.name, id.pose);
    if (!drawn.empty()) json["drawn"] = describe_drawn(drawn);
    const std::vector<Pose> bodies = body_poses(assembly, pose.t_s);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const std::string& name = assembly.scene.instances[assembly.scene.bodies[k].instance];
        json["T_world_object"][name] = describe_pose(bodies[k]);
    }
    for (const auto& source : sonar.settings.sources)
        source->describe(finished.traced.samples, assembly.scene, id.pose, json);
    if (!finished.measured.is_null()) json["measured"] = finished.measured;
    return json;
}

}  // namespace sonarsim
