#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace sonarsim {

/// The place of a node in its source. Nodes share the name of the source.
struct YamlPlace {
    std::shared_ptr<const std::string> source;
    int line = 0;
    int column = 0;

    operator Location() const { return {*source, line, column}; }
};

/// A node of a YAML document as it was written, without its meaning, and its place.
struct YamlNode {
    enum class Kind { empty, scalar, list, map };

    Kind kind = Kind::empty;
    bool quoted = false;   ///< a quoted scalar is text, never a number
    bool implied = false;  ///< a map that only the path of an override created
    YamlPlace place;
    std::string text;             ///< value of a scalar
    std::vector<YamlNode> items;  ///< items of a list or a map, in the order of the file
    std::string key;              ///< key of an item of a map
    YamlPlace key_place;

    /// Returns the item of a map, or nullptr.
    const YamlNode* find(std::string_view wanted) const;
    YamlNode* find(std::string_view wanted);
};

/// The item of a map, or nullptr if there is no node, no map or no such item.
inline YamlNode* child(YamlNode* node, const char* key) {
    return node != nullptr ? node->find(key) : nullptr;
}

/// Adds the keys of `defaults` that `section` lacks, also to the sections below it.
void add_missing(const YamlNode& defaults, YamlNode& section);

/// Removes a key of a map, if it is there.
void erase_key(YamlNode& map, std::string_view key);

/// Sets the place of a value and of all its parts.
void set_place(YamlNode& node, const YamlPlace& place);

/// Nodes of a file remember their lines, nodes of a command line do not.
enum class Lines { counted, none };

/// Reads one YAML document. It may hold maps, lists and scalars, at most 16 deep and 250,000 in
/// all. InputError for anchors, aliases, tags, duplicate keys, keys that are not text, control
/// characters, bytes that are not UTF-8 and further documents. An empty document is an empty node.
YamlNode read_document(std::string_view text, const std::string& source,
                       Lines lines = Lines::counted);

/// A node as YAML in one line, which reads back as the same node.
std::string flow_text(const YamlNode& node);

/// `text` in double quotes, as YAML reads it back.
std::string quoted_text(std::string_view text);

/// `text` for a message: cut when longer than `longest` bytes, control characters masked.
std::string shown(std::string_view text, std::size_t longest);

/// The same in single quotes.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

}  // namespace sonarsim
