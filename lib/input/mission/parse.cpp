#include "input/mission/parse.h"

#include <algorithm>
#include <array>

#include "core/file.h"
#include "core/text.h"
#include "input/mission/dataset_names.h"
#include "input/mission/files.h"
#include "input/mission/override.h"
#include "input/mission/ping_draws.h"
#include "input/mission/preset.h"
#include "input/mission/reader.h"
#include "input/mission/stock.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

YamlNode document_of(std::string_view text, const std::string& file_name,
                     std::span<const std::string> overrides, Lines lines = Lines::counted) {
    if (text.size() > largest_file) throw InputError({file_name}, "is larger than 1 MiB");
    YamlNode root = read_document(text, file_name, lines);
    for (const std::string& setting : overrides)
        apply_override(root, setting);
    return root;
}

bool is_within(std::string_view key, std::string_view section) {
    return key == section || (key.starts_with(section) && key[section.size()] == '.');
}

/// Throws InputError for rules of `vary` whose draws would be overwritten.
void check_rules(const Mission& mission) {
    struct Reserved {
        std::string_view key;
        const char* why;
    };
    constexpr std::array reserved{
        Reserved{"seed", "each variant has a seed of its own, which follows from the mission's"},
        Reserved{"variants", "it says how many variants there are"},
        Reserved{"vary", "it says what varies"},
        Reserved{"output.folder", "each variant has a folder of its own in that of the mission"}};
    ErrorList errors;
    for (auto rule = mission.vary.begin(); rule != mission.vary.end(); ++rule) {
        const auto refuse = [&](const std::string& what) {
            errors.add(InputError(rule->place, "'" + printable(rule->key) + "' " + what));
        };
        for (const Reserved& one : reserved) {
            if (is_within(rule->key, one.key)) refuse(std::string("cannot vary: ") + one.why);
        }
        const auto lost = std::find_if(mission.vary.begin(), rule, [&](const VaryConfig& earlier) {
            return is_within(earlier.key, rule->key);
        });
        if (lost == rule) continue;
        refuse(lost->key == rule->key ? "varies twice; leave out one of the two rules"
                                      : "replaces what is drawn for '" + printable(lost->key) +
                                            "' before it; write that rule after this one");
    }
    errors.raise();
}

}  // namespace

Mission parse_mission(std::string_view text, const std::string& file_name,
                      const std::filesystem::path& base_folder,
                      std::span<const std::string> overrides, SonarKeyTable sonars) {
    return parse_mission(document_of(text, file_name, overrides), file_name, base_folder, sonars);
}

YamlNode read_mission_document(const MissionSource& source) {
    const std::string name = source.file.string();
    if (source.text) return document_of(*source.text, name, source.overrides, Lines::none);
    return document_of(read_file(source.file, largest_file), name, source.overrides);
}

Mission load_mission(const MissionSource& source, SonarKeyTable sonars) {
    Mission mission = parse_mission(read_mission_document(source), source.file.string(),
                                    source.base_folder, sonars);
    namespace fs = std::filesystem;
    const fs::path own_folder = source.file.parent_path();
    const bool is_of_dataset = !source.text && source.base_folder == own_folder &&
                               fs::exists(own_folder / description_name);
    if (is_of_dataset && !fs::exists(files_of(mission).front())) {
        throw InputError({source.file.string()},
                         "belongs to a dataset, and its paths start at the folder of the scene "
                         "file; say which that is with --paths-from FOLDER");
    }
    return mission;
}

Mission parse_mission(const YamlNode& root, const std::string& file_name,
                      const std::filesystem::path& base_folder, SonarKeyTable sonars) {
    Mission mission;
    mission.name = std::filesystem::path(file_name).stem().string();
    YamlNode filled = root;
    fill_in_presets(filled, base_folder);
    fill_in_stock(filled, base_folder);
    ErrorList errors;
    errors.attempt([&] {
        MissionReader reader(filled, "mission", base_folder, sonars, errors);
        describe(reader, mission);
        reader.finish();
    });
    errors.raise();
    complete_scatter(mission.scene);
    check_rules(mission);
    check_ping_draws(mission);
    if (mission.water.sound_speed_m_s == 0.0)
        mission.water.sound_speed_m_s = sound_speed_m_s(mission.water);
    if (mission.output.folder.empty()) {
        mission.output.folder = std::filesystem::absolute("out") / mission.name;
    }
    return mission;
}

}  // namespace sonarsim
