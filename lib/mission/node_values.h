#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mission/document.h"
#include "mission/ground_map_keys.h"
#include "mission/limits.h"
#include "mission/variation_keys.h"

namespace sonarsim {

// Readers of the value of one key. `key` is its name in messages. They throw InputError with the
// place of a wrong value.

[[noreturn]] void refuse(const YamlNode& node, const std::string& what);

/// Throws "'key' must be WANTED, not FOUND".
[[noreturn]] void refuse_type(const YamlNode& node, const std::string& key,
                              const std::string& wanted);

/// "at least 0" for a number that is not within the limits, else "".
std::string fault_of(double value, const Limits& limits);

bool read_flag(const YamlNode& node, const char* key);

/// Reads a path, which becomes absolute and normalised; a relative one starts at `base_folder`.
std::filesystem::path read_path(const YamlNode& node, const char* key,
                                const std::filesystem::path& base_folder);

void read_value(const YamlNode& node, const char* key, const Limits& limits, double& value);
void read_value(const YamlNode& node, const char* key, const Limits& limits, int& value);
void read_value(const YamlNode& node, const char* key, const Limits& limits, std::uint64_t& value);
/// Reads `auto` as nothing.
void read_value(const YamlNode& node, const char* key, const Limits& limits,
                std::optional<double>& value);
/// Reads a number, or a list of the least and the largest.
void read_value(const YamlNode& node, const char* key, const Limits& limits,
                std::array<double, 2>& value);
/// Reads a text that is not empty and has no control characters.
void read_value(const YamlNode& node, const char* key, std::string& value);
void read_value(const YamlNode& node, const char* key, std::vector<std::string>& values);
/// Reads a map from texts to texts.
void read_value(const YamlNode& node, const char* key, Renaming& values);
/// Reads a list of values of any kind, which are kept as YAML.
void read_value(const YamlNode& node, const char* key, YamlValues& values);

/// "a, b, c".
std::string listed(const std::vector<std::string>& names);

/// Values as text, by key.
using KeyTexts = std::vector<std::pair<std::string, std::string>>;

/// " (key is 1, other is 2)": those of `keys` that have a value; "" if none has.
std::string values_text(const KeyTexts& values, std::initializer_list<const char*> keys);

/// Returns the index of the node's text in `names`.
std::size_t index_of(const YamlNode& node, const char* key, const std::vector<std::string>& names);

/// Reads a list of exactly as many numbers as `values` has.
void read_numbers(const YamlNode& node, const char* key, std::span<double> values,
                  const Limits& limits);

/// Returns for each name whether it is chosen: `true` chooses all, `false` none, a list some.
std::vector<bool> chosen_of(const YamlNode& node, const char* key,
                            const std::vector<std::string>& names);

}  // namespace sonarsim
