#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mission/document.h"
#include "mission/limits.h"

namespace sonarsim {

// The value of one key in a document. `key` is what messages call it; InputError with the place of
// the value for whatever is not exactly right.

[[noreturn]] void refuse(const YamlNode& node, const std::string& what);

/// "'key' must be `wanted`, not what stands there".
[[noreturn]] void refuse_type(const YamlNode& node, const std::string& key,
                              const std::string& wanted);

void check_limits(const YamlNode& node, const char* key, double value, const Limits& limits);

/// Whether it is a word or number without quotes.
bool is_plain(const YamlNode& node);

double read_number(const YamlNode& node, const char* key, const Limits& limits);

/// Not empty, and without control characters.
std::string read_text(const YamlNode& node, const char* key);

/// "a, b, c".
std::string listed(const std::vector<std::string>& names);

/// Which of the names it is.
std::size_t index_of(const YamlNode& node, const char* key, const std::vector<std::string>& names);

/// A list of exactly `count` numbers.
void read_numbers(const YamlNode& node, const char* key, double* values, std::size_t count,
                  const Limits& limits);

/// By name whether it is chosen: `true` for all, `false` for none, or a list of some.
std::vector<bool> chosen_of(const YamlNode& node, const char* key,
                            const std::vector<std::string>& names);

}  // namespace sonarsim
