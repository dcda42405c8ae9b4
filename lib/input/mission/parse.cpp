#include "input/mission/parse.h"

#include <memory>

#include "core/file.h"
#include "core/text.h"
#include "input/mission/dataset_names.h"
#include "input/mission/files.h"
#include "input/mission/ping_draws.h"
#include "input/mission/preset.h"
#include "input/mission/reader.h"
#include "input/mission/stock.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

bool is_within(std::string_view key, std::string_view section) {
    return key == section || (key.starts_with(section) && key[section.size()] == '.');
}

/// Throws InputError for rules of `vary` whose draws would be overwritten.
void check_rules(const Mission& mission) {
    constexpr std::pair<std::string_view, const char*> reserved[] = {
        {"seed", "each variant has a seed of its own, which follows from the mission's"},
        {"variants", "it says how many variants there are"},
        {"vary", "it says what varies"},
        {"output.folder", "each variant has a folder of its own in that of the mission"}};
    ErrorList errors;
    for (auto rule = mission.vary.begin(); rule != mission.vary.end(); ++rule) {
        const auto add = [&](const std::string& fault) {
            errors.add(InputError(rule->place, "'" + printable(rule->key) + "' " + fault));
        };
        for (const auto& [key, why] : reserved) {
            if (is_within(rule->key, key)) add(std::string("cannot vary: ") + why);
        }
        const auto lost = std::find_if(mission.vary.begin(), rule, [&](const VaryConfig& earlier) {
            return is_within(earlier.key, rule->key);
        });
        if (lost == rule) continue;
        add(lost->key == rule->key ? "varies twice; leave out one of the two rules"
                                   : "replaces what is drawn for '" + printable(lost->key) +
                                         "' before it; write that rule after this one");
    }
    errors.raise();
}

constexpr std::size_t longest_path = 16;
constexpr const char* usage_of_set = "write --set key=value or --set section.key=value";
constexpr const char* usage_of_key = "'key' is written as key or section.key";

std::vector<std::string> split_path(std::string_view path, const Location& where,
                                    const char* usage) {
    std::vector<std::string> keys;
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        keys.emplace_back(path.substr(start, end - start));
        if (keys.back().empty() || keys.size() > longest_path) throw InputError(where, usage);
        start = end + 1;
    }
    return keys;
}

/// The item of a list or map that a key of a path names; null if there is none.
auto* item_of(auto& node, const std::string& key) {
    if (node.kind != YamlNode::Kind::list) return node.find(key);
    const std::optional<std::uint64_t> index = parse_unsigned(key);
    return index && *index < node.items.size() ? &node.items[*index] : nullptr;
}

/// The item of `node` that `key` names; created if missing. `above` holds `node`, for messages.
YamlNode& descend(const YamlNode& above, YamlNode& node, const std::string& key,
                  const YamlPlace& place) {
    if (YamlNode* const found = item_of(node, key)) return *found;
    if (node.kind == YamlNode::Kind::list)
        refuse(place, "no item {}; the list has {}, counted from 0", in_quotes(key),
               node.items.size());
    if (node.kind == YamlNode::Kind::scalar)
        refuse(place, "there is no key {} below the single value {}", in_quotes(key),
               in_quotes(node.text));
    if (node.implied && parse_unsigned(key)) {
        std::vector<std::string> lists;
        for (const YamlNode& item : above.items) {
            if (item.kind == YamlNode::Kind::list) lists.push_back(item.key);
        }
        refuse(place,
               "there is no list {} with an item {}{}; write the whole list in the mission first",
               in_quotes(node.key), in_quotes(key), did_you_mean(node.key, lists));
    }
    node.kind = YamlNode::Kind::map;
    YamlNode& made = node.items.emplace_back();
    made.implied = true;
    made.place = place;
    made.key = key;
    made.key_place = place;
    return made;
}

/// Replaces the value at the path.
void assign(YamlNode& root, const std::vector<std::string>& path, YamlNode value) {
    const YamlNode* above = &root;
    YamlNode* node = &root;
    for (const std::string& key : path)
        node = &descend(*std::exchange(above, node), *node, key, value.place);
    value.key = std::move(node->key);
    value.key_place = std::move(node->key_place);
    *node = std::move(value);
}

/// Rules that draw what a setting fixes for every ping draw its value alone. They stay in their
/// places, since the draws of the others follow from these.
void fix_rules_of_pings(YamlNode& root, std::string_view setting) {
    YamlNode* const rules = root.find("vary");
    if (rules == nullptr) return;
    for (YamlNode& rule : rules->items) {
        const YamlNode* const per = rule.find("per");
        const YamlNode* const key = rule.find("key");
        if (per == nullptr || per->text != "ping" || key == nullptr) continue;
        if (!is_fixed_by(key->text, setting)) continue;
        const YamlNode* value = &root;
        for (const std::string& name : split_path(key->text, key->place, usage_of_key))
            value = value != nullptr ? item_of(*value, name) : nullptr;
        if (value == nullptr) continue;
        YamlNode choice = rule;
        choice.kind = YamlNode::Kind::list;
        choice.key = "choice";
        choice.items.assign(1, *value);
        choice.items.front().key.clear();
        std::erase_if(rule.items,
                      [](const YamlNode& item) { return item.key != "key" && item.key != "per"; });
        rule.items.push_back(std::move(choice));
    }
}

YamlNode document_of(std::string_view text, const std::string& file_name,
                     const std::filesystem::path& base_folder,
                     std::span<const std::string> overrides, Lines lines = Lines::counted) {
    if (text.size() > largest_file) refuse({file_name}, "is larger than 1 MiB");
    YamlNode root = read_document(text, file_name, lines);
    for (const std::string& setting : overrides)
        apply_override(root, setting);
    if (!overrides.empty()) fill_in_rules(root, base_folder);
    for (const std::string& setting : overrides)
        fix_rules_of_pings(root, setting);
    return root;
}

}  // namespace

bool is_fixed_by(std::string_view key, std::string_view setting) {
    return is_within(key, setting.substr(0, setting.find('=')));
}

Mission parse_mission(std::string_view text, const std::string& file_name,
                      const std::filesystem::path& base_folder,
                      std::span<const std::string> overrides, SonarKeyTable sonars) {
    return parse_mission(document_of(text, file_name, base_folder, overrides), file_name,
                         base_folder, sonars);
}

YamlNode read_mission_document(const MissionSource& source) {
    const std::string name = source.file.string();
    const std::string ending = in_lower_case(source.file.extension().string());
    for (const char* const mesh : {".obj", ".stl", ".ply", ".glb", ".gltf"}) {
        if (!source.text && ending == mesh)
            refuse({name}, "is a mesh; `sonarsim new {}` writes a mission around it", name);
    }
    const std::filesystem::path& folder = source.base_folder;
    if (source.text) return document_of(*source.text, name, folder, source.overrides, Lines::none);
    return document_of(read_file(source.file, largest_file), name, folder, source.overrides);
}

Mission load_mission(const MissionSource& source, SonarKeyTable sonars) {
    Mission mission = parse_mission(read_mission_document(source), source.file.string(),
                                    source.base_folder, sonars);
    namespace fs = std::filesystem;
    const fs::path own_folder = source.file.parent_path();
    const bool is_of_dataset = !source.text && source.base_folder == own_folder &&
                               fs::exists(own_folder / description_name);
    if (is_of_dataset && !fs::exists(files_of(mission).front())) {
        refuse({source.file.string()},
               "belongs to a dataset, and its paths start at the folder of the scene file; say "
               "which that is with --paths-from FOLDER");
    }
    return mission;
}

Mission parse_mission(const YamlNode& root, const std::string& file_name,
                      const std::filesystem::path& base_folder, SonarKeyTable sonars) {
    Mission mission;
    mission.name = std::filesystem::path(file_name).stem().string();
    YamlNode filled = root;
    fill_in_presets(filled, base_folder);
    ErrorList errors;
    fill_in_stock(filled, base_folder, errors);
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

void apply_override(YamlNode& root, const std::string& setting) {
    const std::string source = "--set " + shown(setting, 120);
    const Location where{source};
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw InputError(where, usage_of_set);
    const std::size_t comment = std::min(setting.find(" #", equals), setting.find("=#", equals));
    if (comment < setting.size() && setting.find_first_of("'\"[{", equals) != equals + 1)
        throw InputError(where, "a text with ' #', which begins a comment of YAML, needs quotes");
    assign(root, split_path(std::string_view(setting).substr(0, equals), where, usage_of_set),
           read_document(std::string_view(setting).substr(equals + 1), source, Lines::none));
}

void set_text(YamlNode& root, std::string_view path, const std::string& value,
              const Location& where) {
    YamlNode node = read_document(value, where.file, Lines::none);
    set_place(node, {std::make_shared<const std::string>(where.file), where.line, where.column});
    assign(root, split_path(path, where, usage_of_key), std::move(node));
}

std::optional<double> number_at(const YamlNode& root, std::string_view path) {
    const YamlNode* node = &root;
    for (const std::string& key : split_path(path, {}, usage_of_key)) {
        node = item_of(*node, key);
        if (node == nullptr) return std::nullopt;
    }
    return node->kind == YamlNode::Kind::scalar ? parse_number(node->text) : std::nullopt;
}

}  // namespace sonarsim
