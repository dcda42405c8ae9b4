#include "input/mission/override.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t longest_path = 16;
constexpr const char* usage_of_set = "write --set key=value or --set section.key=value";

std::vector<std::string> split_path(std::string_view path, const Location& where,
                                    const char* usage) {
    std::vector<std::string> keys;
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        keys.emplace_back(path.substr(start, end - start));
        if (keys.back().empty() || keys.size() > longest_path) {
            throw InputError(where, usage);
        }
        start = end + 1;
    }
    return keys;
}

/// The item of `node` that `key` names. A missing item of a map is created. `above` holds `node`,
/// for messages.
YamlNode& descend(const YamlNode& above, YamlNode& node, const std::string& key,
                  const YamlPlace& place) {
    if (node.kind == YamlNode::Kind::list) {
        const std::optional<std::uint64_t> index = parse_unsigned(key);
        if (!index || *index >= node.items.size()) {
            throw InputError(place.location(), "no item " + in_quotes(key) + "; the list has " +
                                                   std::to_string(node.items.size()) +
                                                   ", counted from 0");
        }
        return node.items[*index];
    }
    if (node.kind == YamlNode::Kind::scalar) {
        throw InputError(place.location(), "there is no key " + in_quotes(key) +
                                               " below the single value " + in_quotes(node.text));
    }
    if (node.implied && parse_unsigned(key)) {
        std::vector<std::string> lists;
        for (const YamlNode& item : above.items) {
            if (item.kind == YamlNode::Kind::list) lists.push_back(item.key);
        }
        throw InputError(place.location(), "there is no list " + in_quotes(node.key) +
                                               " with an item " + in_quotes(key) +
                                               did_you_mean(node.key, lists) +
                                               "; write the whole list in the mission first");
    }
    node.kind = YamlNode::Kind::map;
    if (YamlNode* found = node.find(key)) return *found;
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

/// Sets the place of a value and of all its parts.
void set_place(YamlNode& node, const YamlPlace& place) {
    node.place = place;
    node.key_place = place;
    for (YamlNode& item : node.items)
        set_place(item, place);
}

}  // namespace

void apply_override(YamlNode& root, const std::string& setting) {
    const std::string source = "--set " + shown(setting, 120);
    const Location where{source};
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
        throw InputError(where, usage_of_set);
    }
    assign(root, split_path(std::string_view(setting).substr(0, equals), where, usage_of_set),
           read_document(std::string_view(setting).substr(equals + 1), source, Lines::none));
}

void set_text(YamlNode& root, std::string_view path, const std::string& value,
              const Location& where) {
    YamlNode node = read_document(value, where.file, Lines::none);
    set_place(node, {std::make_shared<const std::string>(where.file), where.line, where.column});
    assign(root, split_path(path, where, "'key' is written as key or section.key"),
           std::move(node));
}

std::optional<double> number_at(const YamlNode& root, std::string_view path) {
    const YamlNode* node = &root;
    for (const std::string& key : split_path(path, {}, "'key' is written as key or section.key")) {
        if (node->kind == YamlNode::Kind::list) {
            const std::optional<std::uint64_t> index = parse_unsigned(key);
            node = index && *index < node->items.size() ? &node->items[*index] : nullptr;
        } else {
            node = node->kind == YamlNode::Kind::map ? node->find(key) : nullptr;
        }
        if (node == nullptr) return std::nullopt;
    }
    return node->kind == YamlNode::Kind::scalar ? parse_number(node->text) : std::nullopt;
}

void erase_key(YamlNode& map, std::string_view key) {
    std::erase_if(map.items, [&](const YamlNode& item) { return item.key == key; });
}

}  // namespace sonarsim
