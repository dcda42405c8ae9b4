#include "assembly/assemble.h"

#include <variant>

#include "core/error.h"
#include "core/hash.h"
#include "core/sha256.h"
#include "core/text.h"
#include "core/units.h"
#include "scene/gltf/load.h"
#include "sonar/engine_settings.h"
#include "trajectory/files.h"
#include "trajectory/interpolate.h"
#include "trajectory/patterns.h"

namespace sonarsim {

namespace {

Trajectory poses_of(const FileTrajectoryConfig& config) {
    Trajectory poses = read_trajectory(config.file);
    return config.rate_hz > 0.0 ? resample(poses, config.rate_hz) : poses;
}

Trajectory poses_of(const WaypointTrajectoryConfig& config) {
    std::vector<Waypoint> waypoints;
    for (const WaypointConfig& waypoint : config.waypoints) {
        const auto& [roll, pitch, yaw] = waypoint.rpy_deg;
        waypoints.push_back({Eigen::Vector3d(waypoint.position_m.data()),
                             rotation_from_rpy(radians(roll), radians(pitch), radians(yaw))});
    }
    return follow_waypoints(waypoints, config.speed_m_s, config.rate_hz);
}

Trajectory poses_of(const LawnmowerTrajectoryConfig& config) {
    return lawnmower({Eigen::Vector2d(config.area_min_m.data()),
                      Eigen::Vector2d(config.area_max_m.data()), config.z_m, config.heading_deg,
                      config.line_spacing_m, config.speed_m_s, config.rate_hz});
}

std::vector<InputFile> inputs_of(const Mission& mission) {
    std::vector<InputFile> inputs{{mission.scene.file, {}}, {mission.scene.materials, {}}};
    if (const auto* poses = std::get_if<FileTrajectoryConfig>(&mission.trajectory))
        inputs.push_back({poses->file, {}});
    for (InputFile& input : inputs)
        input.sha256 = sha256_of_file(input.path);
    return inputs;
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return fnv1a_128({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

Assembly assemble(const Mission& mission) {
    Assembly assembly;
    assembly.trajectory =
        std::visit([](const auto& config) { return poses_of(config); }, mission.trajectory);
    const EngineSettings settings = engine_settings(mission);
    for (const SonarConfig& sensor : mission.sensors) {
        const Sonar& sonar = assembly.sonars.emplace_back(make_sonar(sensor, mission.accuracy, mission.water));
        const std::string refusal = refusal_of(settings, sonar.settings.view);
        if (!refusal.empty()) throw InputError("sensor '" + sensor.name + "': " + refusal);
    }
    assembly.scene = load_scene(mission.scene.file, mission.scene.materials,
                                {mission.water.density_kg_m3, mission.water.sound_speed_m_s});
    if (!mission.output.labels.empty() || !mission.classes.empty()) {
        std::vector<ClassRule> rules;
        for (const ClassConfig& rule : mission.classes)
            rules.push_back({rule.nodes, rule.name, rule.instance, rule.place.location});
        assembly.objects = group_objects(assembly.scene, rules);
    }
    const std::string refusal = refusal_of(settings, assembly.scene);
    if (!refusal.empty()) throw InputError(refusal);
    assembly.inputs = inputs_of(mission);
    return assembly;
}

std::string inputs_hash(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    std::string text = hash_of(scene.vertices) + hash_of(scene.triangles) +
                       hash_of(scene.triangle_material) + hash_of(scene.triangle_instance);
    for (const double x : {scene.origin.x(), scene.origin.y(), scene.origin.z()}) {
        text += " " + number_text(x);
    }
    for (const Material& material : scene.materials) {
        text += "\n" + material.name + "\n" + number_text(material.density_kg_m3) + " " +
                number_text(material.sound_speed_m_s) + " " + number_text(material.lambert_db) +
                " " + number_text(material.slope_rms_deg);
    }
    for (const std::string& instance : scene.instances)
        text += "\n" + instance;
    for (std::size_t i = 0; i < scene.instance_classes.size(); ++i) {
        if (scene.instance_classes[i].empty()) continue;
        text += "\nclass " + std::to_string(i) + " " + scene.instance_classes[i];
    }
    return fnv1a_128(text + "\n" + write_tum(assembly.trajectory));
}

}  // namespace sonarsim
