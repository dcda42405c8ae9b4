#include "mission/resolved.h"

#include "mission/schema.h"
#include "mission/writer.h"

namespace sonarsim {

std::string resolved_yaml(const Mission& mission) {
    Mission copy = mission;  // a description may write, so it asks for more than const
    MissionWriter writer;
    describe(writer, copy);
    return writer.yaml();
}

std::string mission_hash(const Mission& mission) {
    Mission copy = mission;
    const std::filesystem::path scene_folder = mission.scene.file.parent_path();
    const auto relative = [&](std::filesystem::path& path) {
        path = path.lexically_proximate(scene_folder);
    };
    relative(copy.scene.file);
    relative(copy.scene.materials);
    if (auto* poses = std::get_if<FileTrajectoryConfig>(&copy.trajectory)) relative(poses->file);
    copy.output.folder.clear();
    return fnv1a_128(resolved_yaml(copy));
}

std::string fnv1a_128(std::string_view bytes) {
    __extension__ using Wide = unsigned __int128;
    constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    Wide hash = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
    for (const char byte : bytes)
        hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
    std::string out;
    for (int shift = 124; shift >= 0; shift -= 4) {
        out += "0123456789abcdef"[static_cast<unsigned>(hash >> shift) & 15U];
    }
    return out;
}

}  // namespace sonarsim
