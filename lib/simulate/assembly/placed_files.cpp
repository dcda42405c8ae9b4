#include "simulate/assembly/placed_files.h"

#include "core/pose.h"
#include "core/text.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/standing.h"

namespace sonarsim {

PlacedFile file_of(const std::filesystem::path& path, const MeshConfig& mesh,
                   const Location& place) {
    return {.file = path,
            .unit_m = metres(mesh.units),
            .z_up = mesh.up == UpAxis::z,
            .up_given = mesh.up_given,
            .material = mesh.material,
            .place = place};
}

PlacedFile file_of(const ObjectConfig& object) {
    PlacedFile file = file_of(object.file, object.mesh, object.place);
    file.name = object.name;
    file.class_name = object.class_name;
    file.moves = object.trajectory.has_value();
    return file;
}

Eigen::Affine3d transform_of(const ObjectConfig& object) {
    Eigen::Affine3d T_world_file = Eigen::Affine3d::Identity();
    T_world_file.translation() = Eigen::Vector3d(object.position_m.data());
    T_world_file.linear() = object.scale * rotation_from_degrees(object.rpy_deg).toRotationMatrix();
    return T_world_file;
}

std::vector<std::string> parts_of(const Mission& mission, const PlacedFile& file) {
    std::vector<std::string> parts;
    const bool is_one_instance = !file.name.empty() || file.seabed || file.heightmap;
    if (is_one_instance) return parts;
    for (const ClassConfig& rule : mission.classes) {
        if (!rule.materials.empty()) parts.push_back(rule.materials);
    }
    return parts;
}

PlacedFile file_of(const HeightmapConfig& map) {
    PlacedFile file{.file = map.file,
                    .z_up = true,
                    .material = map.material,
                    .class_name = map.class_name,
                    .place = map.place};
    file.heightmap = HeightmapRule{
        .pixel_m = map.pixel_m, .cell_m = map.cell_m, .is_scaled = map.height_scale != 1.0};
    file.T_world_file.linear() = Eigen::Vector3d(1.0, 1.0, map.height_scale).asDiagonal();
    file.T_world_file.translation() =
        Eigen::Vector3d(-map.origin_m[0], -map.origin_m[1], map.height_offset_m);
    return file;
}

std::vector<std::string> readings_of(const SceneConfig& scene) {
    std::vector<std::string> readings;
    const auto add = [&](const std::filesystem::path& path, const MeshConfig& mesh) {
        const PlacedFile file = file_of(path, mesh, {});
        if (path.empty() || !is_mesh_file(path)) return;
        std::string text = printable(path.filename().string()) + ": " + reading_of(file);
        if (!contains(readings, text)) readings.push_back(std::move(text));
    };
    add(scene.file, scene.mesh);
    for (const ObjectConfig& object : scene.objects)
        add(object.file, object.mesh);
    for (const ScatterConfig& scatter : scene.scatter) {
        for (const std::filesystem::path& path : scatter.files)
            add(path, scatter.mesh);
    }
    return readings;
}

std::string title_of(const ObjectConfig& object) {
    return "'" + printable(object.name.empty() ? object.file.filename().string() : object.name) +
           "'";
}

double farthest_range_m(const Mission& mission) {
    double range = 0.0;
    for (const SonarConfig& sensor : mission.sensors)
        range = std::max(range, sensor.range_max_m);
    return range;
}

}  // namespace sonarsim
