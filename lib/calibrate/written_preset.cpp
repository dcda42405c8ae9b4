#include "calibrate/written_preset.h"

#include <optional>
#include <sstream>

#include "core/error.h"

namespace sonarsim {

namespace {

/// A line "key: value  # comment" of a block.
struct PresetLine {
    std::size_t indent = 0;
    std::string key;
    std::string value;
};

std::optional<PresetLine> parsed(const std::string& line) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || line[indent] == '#' || line[indent] == '-') return {};
    const std::size_t colon = line.find(':', indent);
    if (colon == std::string::npos) return {};
    PresetLine out{indent, line.substr(indent, colon - indent), line.substr(colon + 1)};
    const std::size_t comment = out.value.find('#');
    if (comment != std::string::npos) out.value.erase(comment);
    const std::size_t end = out.value.find_last_not_of(" \t\r");
    out.value.erase(end == std::string::npos ? 0 : end + 1);
    return out;
}

std::string text_of(const PresetValue& value, const std::string& key, std::size_t indent) {
    return std::string(indent, ' ') + key + ": " + value.value + "  # " + value.comment;
}

/// The lines of a preset, and its name for errors.
struct PresetText {
    std::vector<std::string> lines;
    std::string name;

    /// The line of a key at this indent within [begin, end).
    std::optional<std::size_t> find(const std::string& key, std::size_t indent, std::size_t begin,
                                    std::size_t end) const {
        for (std::size_t k = begin; k < end; ++k) {
            const std::optional<PresetLine> line = parsed(lines[k]);
            if (line && line->indent == indent && line->key == key) return k;
        }
        return {};
    }

    std::size_t end_of_block(std::size_t begin, std::size_t indent) const {
        for (std::size_t k = begin; k < lines.size(); ++k) {
            const std::optional<PresetLine> line = parsed(lines[k]);
            if (line && line->indent <= indent) return k;
        }
        return lines.size();
    }

    /// The indent of the first key in [begin, end), else two more than that of the section.
    std::size_t indent_in(std::size_t begin, std::size_t end, std::size_t section) const {
        for (std::size_t k = begin; k < end; ++k) {
            if (const std::optional<PresetLine> line = parsed(lines[k])) return line->indent;
        }
        return section + 2;
    }

    void insert(std::size_t at, std::string line) {
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), std::move(line));
    }

    void set(const PresetValue& value) {
        std::size_t begin = 0;
        std::size_t end = lines.size();
        std::size_t indent = 0;
        std::istringstream path(value.key);
        std::string key;
        std::getline(path, key, '.');
        for (std::string next; std::getline(path, next, '.'); key = next) {
            std::optional<std::size_t> at = find(key, indent, begin, end);
            if (!at) {
                at = end;
                insert(*at, std::string(indent, ' ') + key + ":");
            } else if (!parsed(lines[*at])->value.empty()) {
                throw InputError(Location{name, static_cast<int>(*at) + 1},
                                 "write each key of '" + key +
                                     "' in a line of its own, so that it can be replaced");
            }
            begin = *at + 1;
            end = end_of_block(begin, indent);
            indent = indent_in(begin, end, indent);
        }
        const std::optional<std::size_t> at = find(key, indent, begin, end);
        if (at) {
            lines[*at] = text_of(value, key, indent);
        } else {
            insert(begin, text_of(value, key, indent));
        }
    }
};

}  // namespace

std::string with_values(const std::string& preset, const std::string& name,
                        const std::vector<PresetValue>& values) {
    PresetText text{{}, name};
    std::istringstream in(preset);
    for (std::string line; std::getline(in, line);)
        text.lines.push_back(line);
    while (!text.lines.empty() && text.lines.back().empty())
        text.lines.pop_back();
    for (const PresetValue& value : values)
        text.set(value);
    std::string out;
    for (const std::string& line : text.lines)
        out += line + "\n";
    return out;
}

}  // namespace sonarsim
