#include "mission/differences.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/error.h"
#include "mission/document.h"

namespace sonarsim {

namespace {

std::string value_of(const YamlNode* node) {
    return node == nullptr ? "not given" : shown(flow_text(*node), 40);
}

void compare(const YamlNode* there, const YamlNode* here, const std::string& key,
             std::vector<std::string>& out);

void compare_maps(const YamlNode& there, const YamlNode& here, const std::string& prefix,
                  std::vector<std::string>& out) {
    for (const YamlNode& item : there.items)
        compare(&item, here.find(item.key), prefix + item.key, out);
    for (const YamlNode& item : here.items) {
        if (there.find(item.key) == nullptr) compare(nullptr, &item, prefix + item.key, out);
    }
}

/// Adds the keys below and at `key` whose values differ. A node that is missing is null.
void compare(const YamlNode* there, const YamlNode* here, const std::string& key,
             std::vector<std::string>& out) {
    if (there != nullptr && here != nullptr) {
        const auto both_are = [&](YamlNode::Kind kind) {
            return there->kind == kind && here->kind == kind;
        };
        const std::string prefix = key.empty() ? "" : key + ".";
        if (both_are(YamlNode::Kind::map)) return compare_maps(*there, *here, prefix, out);
        const auto has_parts = [](const YamlNode& item) {
            return item.kind == YamlNode::Kind::map;
        };
        if (both_are(YamlNode::Kind::list) && there->items.size() == here->items.size() &&
            std::ranges::any_of(here->items, has_parts)) {
            for (std::size_t i = 0; i < here->items.size(); ++i)
                compare(&there->items[i], &here->items[i], prefix + std::to_string(i), out);
            return;
        }
        if (flow_text(*there) == flow_text(*here)) return;
    }
    out.push_back(key + ": " + value_of(there) + " there, " + value_of(here) + " here");
}

}  // namespace

std::string differing_keys(std::string_view there, std::string_view here) {
    constexpr std::size_t most = 4;
    std::vector<std::string> keys;
    try {
        const YamlNode before = read_document(there, "there");
        const YamlNode now = read_document(here, "here");
        compare(&before, &now, "", keys);
    } catch (const InputError&) {
        return "";
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(most, keys.size()); ++i)
        text += (text.empty() ? " (" : "; ") + keys[i];
    if (keys.size() > most) text += "; and " + std::to_string(keys.size() - most) + " more";
    return text.empty() ? "" : text + ")";
}

}  // namespace sonarsim
