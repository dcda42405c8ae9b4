#include "input/mission/preset.h"

#include <system_error>

#include "core/file.h"
#include "core/module.h"
#include "core/text.h"
#include "input/mission/value_types.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_preset = std::size_t{1} << 20;

constexpr const char* preset_key = "preset";

/// The folders with files that come with the program: share/ of an installation, or the checkout
/// that holds the build folder. The module of Python lies beside share/ in a wheel, three folders
/// below a checkout, or four below the prefix of an installation.
std::vector<std::filesystem::path> shipped_folders() {
    std::vector<std::filesystem::path> out;
    const auto add = [&](const std::filesystem::path& above) {
        out.insert(out.end(), {above / "share/sonarsim/configs", above / "configs"});
    };
    std::filesystem::path above = module_of_python().parent_path();
    for (int level = 0; !above.empty() && level < 5; ++level, above = above.parent_path())
        add(above);
    std::error_code unknown;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (!unknown) add(program.parent_path().parent_path());
    return out;
}

/// Reads the file that the value of a key `preset` names.
YamlNode read_preset_file(const YamlNode& name, const std::filesystem::path& base_folder,
                          const std::string& kind) {
    if (name.kind != YamlNode::Kind::scalar || name.text.empty())
        refuse(name.place, "'preset' must be the path of a YAML file");
    const std::filesystem::path path = preset_file(name.text, base_folder);
    if (path.empty()) {
        const auto file = std::filesystem::absolute(base_folder / name.text).lexically_normal();
        refuse(name.place,
               "there is no preset {}, and none of this name came with the program{}, written as "
               "{}/NAME.yaml",
               in_quotes(file.string()), shipped_hint(name.text, kind), kind);
    }
    return read_document(read_file(path, largest_preset), path.string());
}

/// Fills in the keys of the file that the key `preset` of a section names, if there is one.
void fill_in_section(YamlNode& section, const std::filesystem::path& base_folder,
                     const std::string& kind) {
    const YamlNode* const name = section.find(preset_key);
    if (name == nullptr) return;
    const YamlNode preset = read_preset_file(*name, base_folder, kind);
    if (preset.kind != YamlNode::Kind::map) refuse(preset.place, "a preset is a section of keys");
    if (const YamlNode* const nested = preset.find(preset_key))
        refuse(nested->key_place, "a preset cannot name a preset");
    const YamlNode* const own_kind = section.find("kind");
    const YamlNode* const its_kind = preset.find("kind");
    if (own_kind != nullptr && its_kind != nullptr && own_kind->text != its_kind->text) {
        refuse(own_kind->place,
               "{} is the preset of a sonar of the kind {}; leave 'kind' out, or take another",
               in_quotes(name->text), in_quotes(its_kind->text));
    }
    erase_key(section, preset_key);
    section.implied = false;
    add_missing(preset, section);
}

/// The items of `vary`, with the rules of presets in place of the items that name one. Rules of the
/// mission's own have precedence over those for the same key.
std::vector<YamlNode> rules_of(const YamlNode& vary, const std::filesystem::path& base_folder) {
    std::vector<YamlNode> rules;
    const auto is_given = [&](const std::string& key) {
        return std::ranges::any_of(vary.items, [&](const YamlNode& rule) {
            const YamlNode* const own = rule.find("key");
            return own != nullptr && own->text == key;
        });
    };
    for (const YamlNode& item : vary.items) {
        const YamlNode* const name = item.find(preset_key);
        if (name == nullptr) {
            rules.push_back(item);
            continue;
        }
        const YamlNode* const sensor = item.find("sensor");
        if ((sensor != nullptr && sensor->text.empty()) ||
            item.items.size() != (sensor != nullptr ? 2U : 1U)) {
            refuse(item.place,
                   "a preset of 'vary' takes the key 'sensor', the name of the sensor that it "
                   "varies, and no other key");
        }
        const YamlNode preset = read_preset_file(*name, base_folder, randomised_presets);
        if (preset.kind != YamlNode::Kind::list)
            refuse(preset.place, "a preset of 'vary' is a list of rules");
        for (YamlNode rule : preset.items) {
            YamlNode* const key = rule.find("key");
            if (key == nullptr) refuse(rule.place, "a rule of 'vary' needs the key 'key'");
            if (sensor != nullptr) key->text = "sensors." + sensor->text + "." + key->text;
            if (!is_given(key->text)) rules.push_back(std::move(rule));
        }
    }
    return rules;
}

}  // namespace

std::filesystem::path shipped_file(const std::filesystem::path& name) {
    std::error_code unknown;
    if (name.is_absolute()) return {};
    for (const std::filesystem::path& folder : shipped_folders()) {
        std::filesystem::path path = folder / name;
        if (std::filesystem::is_regular_file(path, unknown)) return path;
    }
    return {};
}

std::filesystem::path preset_file(const std::filesystem::path& name,
                                  const std::filesystem::path& base_folder) {
    auto path = std::filesystem::absolute(base_folder / name).lexically_normal();
    return std::filesystem::is_regular_file(path) ? path : shipped_file(name);
}

std::vector<std::string> shipped_presets(const std::string& kind) {
    std::vector<std::string> names;
    std::error_code unknown;
    for (const std::filesystem::path& folder : shipped_folders()) {
        for (const auto& file : std::filesystem::directory_iterator(folder / kind, unknown)) {
            if (file.path().extension() == ".yaml") names.push_back(file.path().stem().string());
        }
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string shipped_hint(std::string name, const std::string& kind) {
    std::ranges::replace(name, '\\', '/');
    const std::vector<std::string> names = shipped_presets(kind);
    const std::string stem = std::filesystem::path(name).stem().string();
    if (contains(names, stem)) return " (did you mean '" + kind + "/" + stem + ".yaml'?)";
    return did_you_mean(stem, names) + "; there are: " + listed(names);
}

void fill_in_rules(YamlNode& mission, const std::filesystem::path& base_folder) {
    YamlNode* const vary = mission.find("vary");
    if (vary != nullptr && vary->kind == YamlNode::Kind::list)
        vary->items = rules_of(*vary, base_folder);
}

void fill_in_presets(YamlNode& mission, const std::filesystem::path& base_folder) {
    if (YamlNode* const seabed = child(mission.find("scene"), "seabed"))
        fill_in_section(*seabed, base_folder, seabed_presets);
    fill_in_rules(mission, base_folder);
    YamlNode* const sensors = mission.find("sensors");
    if (sensors == nullptr || sensors->kind != YamlNode::Kind::map) return;
    for (YamlNode& sensor : sensors->items)
        fill_in_section(sensor, base_folder, sensor_presets);
}

}  // namespace sonarsim
