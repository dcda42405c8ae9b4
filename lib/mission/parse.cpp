#include "mission/parse.h"

#include "core/file.h"
#include "mission/override.h"
#include "mission/preset.h"
#include "mission/reader.h"
#include "mission/schema.h"
#include "mission/sound_speed.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

YamlNode document_of(std::string_view text, const std::string& file_name,
                     std::span<const std::string> overrides) {
    if (text.size() > largest_file) throw InputError({file_name}, "is larger than 1 MiB");
    YamlNode root = read_document(text, file_name);
    for (const std::string& setting : overrides)
        apply_override(root, setting);
    return root;
}

}  // namespace

Mission load_mission(const std::filesystem::path& file, std::span<const std::string> overrides,
                     SonarKeyTable sonars) {
    return load_mission(file, file.parent_path(), overrides, sonars);
}

Mission load_mission(const std::filesystem::path& file, const std::filesystem::path& base_folder,
                     std::span<const std::string> overrides, SonarKeyTable sonars) {
    return parse_mission(read_file(file, largest_file), file.string(), base_folder, overrides,
                         sonars);
}

Mission parse_mission(std::string_view text, const std::string& file_name,
                      const std::filesystem::path& base_folder,
                      std::span<const std::string> overrides, SonarKeyTable sonars) {
    return parse_mission(document_of(text, file_name, overrides), file_name, base_folder, sonars);
}

YamlNode read_mission_document(const std::filesystem::path& file,
                               std::span<const std::string> overrides) {
    return document_of(read_file(file, largest_file), file.string(), overrides);
}

Mission parse_mission(const YamlNode& root, const std::string& file_name,
                      const std::filesystem::path& base_folder, SonarKeyTable sonars) {
    Mission mission;
    mission.name = std::filesystem::path(file_name).stem().string();
    YamlNode filled = root;
    fill_in_presets(filled, base_folder);
    Problems problems;
    problems.attempt([&] {
        MissionReader reader(filled, "mission", base_folder, sonars, problems);
        describe(reader, mission);
        reader.finish();
    });
    problems.raise();
    if (mission.water.sound_speed_m_s == 0.0)
        mission.water.sound_speed_m_s = sound_speed_m_s(mission.water);
    if (mission.output.folder.empty()) {
        mission.output.folder = std::filesystem::absolute("out") / mission.name;
    }
    return mission;
}

}  // namespace sonarsim
