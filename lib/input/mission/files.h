#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "input/mission/mission.h"

namespace sonarsim {

/// Calls `visit` with every path that a mission reads; the paths of a const mission are const.
void for_each_file(auto& mission, const auto& visit) {
    const auto poses_of = [&](auto& trajectory) {
        if (auto* poses = std::get_if<FileTrajectoryConfig>(&trajectory)) visit(poses->file);
    };
    if (!mission.scene.file.empty()) visit(mission.scene.file);
    if (mission.scene.heightmap) visit(mission.scene.heightmap->file);
    if (mission.scene.sediment_map) visit(mission.scene.sediment_map->file);
    if (mission.scene.backscatter_map) visit(mission.scene.backscatter_map->file);
    visit(mission.scene.materials);
    for (auto& object : mission.scene.objects) {
        visit(object.file);
        if (object.trajectory) poses_of(*object.trajectory);
    }
    for (auto& scatter : mission.scene.scatter) {
        for (auto& file : scatter.files)
            visit(file);
    }
    poses_of(mission.trajectory);
    if (auto& profile = mission.water.profile; profile && !profile->file.empty())
        visit(profile->file);
}

/// The same as a list.
inline std::vector<std::filesystem::path> files_of(const Mission& mission) {
    std::vector<std::filesystem::path> files;
    for_each_file(mission, [&](const std::filesystem::path& file) { files.push_back(file); });
    return files;
}

/// The folder at which the relative paths of a dataset's mission start: the folder of the scene
/// file, or of the materials file if there is no scene file.
inline std::filesystem::path home_of(const Mission& mission) {
    const SceneConfig& scene = mission.scene;
    return (scene.file.empty() ? scene.materials : scene.file).parent_path();
}

}  // namespace sonarsim
