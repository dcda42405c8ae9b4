#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/text.h"
#include "mission/document.h"
#include "mission/ground_map_config.h"
#include "mission/variation_config.h"

// The value of a key as YAML; "": the key is not written.

namespace sonarsim {

inline std::string yaml_text(double value) {
    return number_text(value);
}
inline std::string yaml_text(int value) {
    return std::to_string(value);
}
inline std::string yaml_text(std::uint64_t value) {
    return std::to_string(value);
}
inline std::string yaml_text(bool value) {
    return value ? "true" : "false";
}
inline std::string yaml_text(const std::optional<double>& value) {
    return value ? number_text(*value) : "auto";
}

/// Text is always quoted, so that a sensor named "null" stays text.
inline std::string yaml_text(const std::string& value) {
    return value.empty() ? "" : quoted_text(value);
}
inline std::string yaml_text(const std::filesystem::path& value) {
    return yaml_text(value.string());
}

/// "[1, 2]"; "" for no items.
template <class Items, class ToText>
std::string yaml_list(const Items& items, const ToText& to_text) {
    std::string list;
    for (const auto& item : items)
        list += (list.empty() ? "[" : ", ") + to_text(item);
    return list.empty() ? "" : list + "]";
}

template <class T>
std::string yaml_text(const std::vector<T>& values) {
    return yaml_list(values, [](const T& value) { return yaml_text(value); });
}
template <std::size_t N>
std::string yaml_text(const std::array<double, N>& values) {
    return yaml_list(values, number_text);
}
template <std::size_t N>
std::string yaml_text(const std::optional<std::array<double, N>>& values) {
    return values ? yaml_text(*values) : "";
}
inline std::string yaml_text(const YamlValues& values) {
    return yaml_list(values.items, [](const std::string& item) { return item; });
}
inline std::string yaml_text(const Renaming& values) {
    std::string map;
    for (const auto& [from, to] : values)
        map += (map.empty() ? "{" : ", ") + quoted_text(from) + ": " + quoted_text(to);
    return map.empty() ? "" : map + "}";
}

}  // namespace sonarsim
