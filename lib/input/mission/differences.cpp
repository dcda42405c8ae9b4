#include "input/mission/differences.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "input/mission/document.h"

namespace sonarsim {

namespace {

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
