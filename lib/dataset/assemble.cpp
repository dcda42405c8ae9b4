#include "dataset/assemble.h"

#include <variant>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "mission/resolved.h"
#include "scene/gltf/load.h"
#include "trajectory/files.h"
#include "trajectory/interpolate.h"
#include "trajectory/patterns.h"
#include "visibility/octree/octree_engine.h"
#include "visibility/rays/rays_engine.h"

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

/// Rows of the octree's cells are equal in the tangent of elevation, which has no end at 90
/// degrees.
constexpr double widest_octree_deg = 160.0;

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return fnv1a_128({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

void check_engine(const Mission& mission) {
    if (mission.engine != EngineKind::octree) return;
    for (const SonarConfig& sensor : mission.sensors) {
        const bool cone = sensor.kind == SonarKind::echosounder;
        const double width = cone ? sensor.azimuth_deg : sensor.elevation_deg;
        if (width <= widest_octree_deg) continue;
        throw InputError("sensor '" + sensor.name + "': engine: octree takes " +
                         (cone ? "opening_deg" : "elevation_deg") + " up to " +
                         number_text(widest_octree_deg) + ", not " + number_text(width) +
                         "; use engine: rays");
    }
}

Assembly assemble(const Mission& mission) {
    check_engine(mission);
    Assembly assembly;
    assembly.trajectory =
        std::visit([](const auto& config) { return poses_of(config); }, mission.trajectory);
    for (const SonarConfig& sensor : mission.sensors) {
        assembly.sonars.push_back(make_sonar(sensor, mission.accuracy));
    }
    assembly.scene = load_scene(mission.scene.file, mission.scene.materials,
                                {mission.water.density_kg_m3, mission.water.sound_speed_m_s});
    return assembly;
}

std::unique_ptr<Surface> make_surface(const Scene& scene, EngineKind engine,
                                      const OctreeConfig& octree) {
    if (engine != EngineKind::octree) return make_rays_surface(scene);
    return make_octree_surface(
        scene, {octree.leaf_m, static_cast<std::size_t>(octree.memory_mb), octree.literal});
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
                number_text(material.sound_speed_m_s);
    }
    for (const std::string& instance : scene.instances)
        text += "\n" + instance;
    return fnv1a_128(text + "\n" + write_tum(assembly.trajectory));
}

}  // namespace sonarsim
