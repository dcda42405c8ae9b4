#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonarsim {

/// The cause of a fault that the YAML parser found in a line, counted from 0, in words for users;
/// the parser's message `fault` if the cause is unknown.
std::string cause_of(const std::string& fault, int line_number, std::string_view text);

/// True if the quoted text from `at` on is closed. The parser takes the file's end for a quote.
bool is_closed(std::string_view text, std::size_t at);

}  // namespace sonarsim
