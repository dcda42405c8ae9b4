#include "input/mission/reader.h"

#include "core/text.h"
#include "input/mission/dataset_names.h"

namespace sonarsim {

namespace {

bool is_name(std::string_view text) {
    constexpr std::string_view allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !text.empty() && text.size() <= 64 &&
           text.find_first_not_of(allowed) == std::string_view::npos;
}

/// The cure for a key that is known, but not in this section; "" for any other.
std::string misplaced(const std::string& key, const std::vector<std::string>& known) {
    if (contains(known, "sensors")) {
        constexpr std::array sensor_keys{"instrument", "model",       "mount",       "multipath",
                                         "noise",      "range_max_m", "range_min_m", "streaks"};
        if (contains(sensor_keys, key)) return "; it belongs to a sensor: sensors.NAME." + key;
    }
    if (!contains(known, "range_max_m")) return "";
    if (key == "instrument") return "; it needs model: calibrated";
    if (key == "noise" || key == "streaks") return "; it needs model: paper";
    if (key == "azimuth_bins" || key == "azimuth_deg" || key == "elevation_deg")
        return "; this kind of sonar has none, leave it out";
    return "";
}

}  // namespace

MissionReader::MissionReader(const YamlNode& node, std::string name,
                             const std::filesystem::path& base_folder, SonarKeyTable sonars,
                             ErrorList& errors)
    : node_(node),
      name_(std::move(name)),
      base_folder_(base_folder),
      sonars_(sonars),
      errors_(errors) {
    if (node.kind != YamlNode::Kind::map) refuse_type(node, name_, "a section of keys");
}

const YamlNode* MissionReader::find(const char* key, Presence presence) {
    known_.emplace_back(key);
    const YamlNode* found_node = node_.find(key);
    if (found_node == nullptr && presence == Presence::required) {
        // The key may be misspelt.
        for (const YamlNode& item : node_.items) {
            const std::string hint = did_you_mean(item.key, std::vector<std::string>{key});
            if (!hint.empty())
                refuse(item.key_place, "unknown key {}{}", in_quotes(item.key), hint);
        }
        refuse(node_.place, "'{}' lacks the key '{}'", name_, key);
    }
    return found_node;
}

const SonarKeys& MissionReader::one_of(const char* key, SonarConfig& value,
                                       const char* /*meaning*/) {
    const SonarKeys& keys = sonars_[index_of(*find(key, required), key, names_of(sonars_))];
    std::string name = std::move(value.name);
    value = keys.defaults;
    value.name = std::move(name);
    return keys;
}

void MissionReader::one_of(TrajectoryConfig& value, const std::vector<std::string>& keys) const {
    std::vector<std::string> present;
    std::string hint;
    for (const YamlNode& item : node_.items) {
        if (contains(keys, item.key)) present.push_back(item.key);
        if (hint.empty()) hint = did_you_mean(item.key, keys);
    }
    if (present.empty())
        refuse(node_.place, "'{}' needs one of the keys: {}{}", name_, listed(keys), hint);
    if (present.size() > 1)
        refuse(node_.find(present[1])->key_place, "'{}' takes one of the keys: {}; here are {}",
               name_, listed(keys), listed(present));
    static_assert(std::variant_size_v<TrajectoryConfig> == 4);
    if (present[0] == keys[0]) value = FileTrajectoryConfig{.file = {}, .place = node_.place};
    if (present[0] == keys[1]) value = WaypointTrajectoryConfig{};
    if (present[0] == keys[2]) value = LawnmowerTrajectoryConfig{};
    if (present[0] == keys[3]) value = LookAtTrajectoryConfig{};
}

std::span<const YamlNode> MissionReader::list_items(const char* key, std::size_t fewest) {
    const Presence presence = fewest > 0 ? Presence::required : Presence::optional;
    const YamlNode* const node = find(key, presence);
    if (node == nullptr) return {};
    if (node->kind != YamlNode::Kind::list) refuse_type(*node, key, "a list");
    if (node->items.size() < fewest)
        refuse(node->place, "'{}' must have at least {} items, not {}", key, fewest,
               node->items.size());
    return node->items;
}

const std::vector<YamlNode>& MissionReader::named_items(const char* key) {
    const YamlNode& node = *find(key, Presence::required);
    if (node.kind != YamlNode::Kind::map) refuse_type(node, key, "a section of names");
    if (node.items.empty()) refuse(node.place, "'{}' must not be empty", key);
    std::vector<std::string> names;
    for (const YamlNode& item : node.items) {
        if (item.implied) {
            const std::string hint = did_you_mean(item.key, names);
            refuse(item.place, "there is no {} in '{}'{}", in_quotes(item.key), key,
                   hint.empty() ? "; there are: " + listed(names) : hint);
        }
        if (!is_name(item.key))
            refuse(item.key_place, "the name {} must be 1 to 64 letters, digits, '_' or '-'",
                   in_quotes(item.key));
        if (is_taken_by_dataset(item.key))
            refuse(item.key_place,
                   "the name {} is that of a file or folder of the dataset; take another",
                   in_quotes(item.key));
        names.push_back(item.key);
    }
    return node.items;
}

void MissionReader::require(bool holds, std::initializer_list<const char*> keys,
                            const char* message) {
    if (holds) return;
    const auto is_faulty = [&](const char* key) { return contains(faulty_, key); };
    if (std::ranges::any_of(keys, is_faulty)) return;
    const YamlNode* last = nullptr;
    // An override has no line and counts as written after the file.
    const auto after = [](const YamlPlace& a, const YamlPlace& b) {
        if (a.line == 0 || b.line == 0) return a.line == 0;
        return std::pair(a.line, a.column) > std::pair(b.line, b.column);
    };
    for (const char* key : keys) {
        const YamlNode* node = node_.find(key);
        if (node != nullptr && (last == nullptr || after(node->place, last->place))) last = node;
    }
    std::vector<std::string> values;
    for (const auto& [key, value] : numbers_) {
        if (contains(keys, key))
            values.push_back(key + (value.empty() ? " is not given" : " is " + value));
    }
    const std::string ending = values.empty() ? "" : " (" + listed(values) + ")";
    const YamlNode& fault = last != nullptr ? *last : node_;
    errors_.attempt([&] { refuse(fault.place, "{}{}", message, ending); });
    faulty_.insert(faulty_.end(), keys.begin(), keys.end());
}

void MissionReader::finish() {
    for (const YamlNode& item : node_.items) {
        if (contains(known_, item.key)) continue;
        std::string hint = misplaced(item.key, known_);
        if (hint.empty()) hint = did_you_mean(item.key, known_);
        if (hint.empty()) hint = "; known here: " + listed(known_);
        errors_.attempt(
            [&] { refuse(item.key_place, "unknown key {}{}", in_quotes(item.key), hint); });
    }
}

}  // namespace sonarsim
