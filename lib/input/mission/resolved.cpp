#include "input/mission/resolved.h"

#include <initializer_list>
#include <map>

#include "core/error.h"
#include "core/hash.h"
#include "input/mission/document.h"
#include "input/mission/files.h"
#include "input/mission/value_types.h"

namespace sonarsim {

namespace {

/// The visitor that writes a mission as YAML, with all values. It checks nothing.
class MissionWriter : public KeyVisitor<MissionWriter> {
  public:
    explicit MissionWriter(SonarKeyTable sonars) : sonars_(sonars) {}

    const std::string& yaml() const { return yaml_; }

    void value(const char* key, const auto& value, const auto& type, const char* /*meaning*/,
               Presence) {
        const std::string text = type.yaml(value);
        if (!text.empty()) line(key, text);
    }

    void section(std::string_view key, auto& value, const char* /*meaning*/,
                 Presence = Presence::optional) {
        line(key, "");
        indent_ += 2;
        describe(*this, value);
        indent_ -= 2;
    }

    template <class T>
    void section(std::string_view key, std::optional<T>& value, const char* meaning) {
        if (value) section(key, *value, meaning);
    }

    void list_of(const char* key, auto& values, std::size_t, const char* /*meaning*/) {
        line(key, values.empty() ? "[]" : "");
        indent_ += 4;
        for (auto& value : values) {
            item_ = true;
            describe(*this, value);
        }
        indent_ -= 4;
    }

    void named(const char* key, auto& values, const char* meaning) {
        line(key, "");
        indent_ += 2;
        for (auto& value : values)
            section(quoted_text(value.name), value, meaning);
        indent_ -= 2;
    }

    void one_of(const TrajectoryConfig&, std::initializer_list<const char*>) const {}

    const SonarKeys& one_of(const char* key, const SonarConfig& value, const char* /*meaning*/) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        line(key, keys->name);
        return *keys;
    }

    void require(bool, std::initializer_list<const char*>, const char*) const {}

  private:
    void line(std::string_view key, std::string_view value) {
        yaml_.append(item_ ? indent_ - 2 : indent_, ' ');
        if (item_) yaml_ += "- ";
        item_ = false;
        yaml_.append(key).append(":");
        if (!value.empty()) yaml_.append(" ").append(value);
        yaml_ += '\n';
    }

    SonarKeyTable sonars_;
    std::string yaml_;
    std::size_t indent_ = 0;
    bool item_ = false;  ///< the next line begins an item of a list
};

/// Adds the values below a node by their keys, as "objects.1.x". Lists of values are one value.
void flatten(const YamlNode& node, const std::string& key,
             std::map<std::string, std::string>& values) {
    const bool is_list = node.kind == YamlNode::Kind::list;
    const auto is_section = [](const YamlNode& item) { return item.kind == YamlNode::Kind::map; };
    if (!is_section(node) && !(is_list && std::ranges::any_of(node.items, is_section))) {
        values[key] = shown(flow_text(node), 40);
        return;
    }
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const std::string own = is_list ? std::to_string(i) : node.items[i].key;
        flatten(node.items[i], key.empty() ? own : key + "." + own, values);
    }
}

}  // namespace

std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars) {
    Mission copy = mission;  // describe() takes no const mission
    MissionWriter writer(sonars);
    describe(writer, copy);
    return writer.yaml();
}

Mission portable(const Mission& mission) {
    Mission copy = mission;
    const std::filesystem::path home = home_of(mission);
    for_each_file(copy,
                  [&](std::filesystem::path& path) { path = path.lexically_proximate(home); });
    copy.output.folder.clear();
    return copy;
}

std::string mission_hash(const Mission& mission, SonarKeyTable sonars) {
    return fnv1a_128(resolved_yaml(portable(mission), sonars));
}

std::string differing_keys(std::string_view there, std::string_view here) {
    constexpr std::size_t max_listed = 4;
    constexpr const char* absent = "not given";
    std::map<std::string, std::string> before;
    std::map<std::string, std::string> now;
    try {
        flatten(read_document(there, "there"), "", before);
        flatten(read_document(here, "here"), "", now);
    } catch (const InputError&) {
        return "";
    }
    for (const auto& one : now)
        before.try_emplace(one.first, absent);
    std::string text;
    std::size_t count = 0;
    for (const auto& [key, value] : before) {
        const auto found = now.find(key);
        const std::string other = found == now.end() ? absent : found->second;
        if (value == other || ++count > max_listed) continue;
        text += (text.empty() ? " (" : "; ") + key + ": " + value + " there, " + other + " here";
    }
    if (count > max_listed) text += "; and " + std::to_string(count - max_listed) + " more";
    return text.empty() ? "" : text + ")";
}

}  // namespace sonarsim
