#include "mission/resolved.h"

#include "core/hash.h"
#include "mission/schema.h"
#include "mission/writer.h"

namespace sonarsim {

std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars) {
    Mission copy = mission;  // a description may write, so it asks for more than const
    MissionWriter writer(sonars);
    describe(writer, copy);
    return writer.yaml();
}

Mission portable(const Mission& mission) {
    Mission copy = mission;
    const std::filesystem::path scene_folder = mission.scene.file.parent_path();
    const auto relative = [&](std::filesystem::path& path) {
        path = path.lexically_proximate(scene_folder);
    };
    relative(copy.scene.file);
    relative(copy.scene.materials);
    if (auto* poses = std::get_if<FileTrajectoryConfig>(&copy.trajectory)) relative(poses->file);
    copy.output.folder.clear();
    return copy;
}

std::string mission_hash(const Mission& mission, SonarKeyTable sonars) {
    return fnv1a_128(resolved_yaml(portable(mission), sonars));
}

}  // namespace sonarsim
