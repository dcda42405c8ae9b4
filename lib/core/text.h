#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sonarsim {

/// The whole of `text` as a finite or infinite decimal number ("1", "-2.5e-3", "inf", "nan");
/// nothing when anything is left over. Never octal, never hexadecimal, never a locale's comma.
std::optional<double> parse_number(std::string_view text);

/// The whole of `text` as a decimal integer; nothing when it is not one or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// The shortest decimal text that reads back as the same number.
std::string number_text(double value);

std::string_view trim(std::string_view text);

/// Length of the well-formed UTF-8 character that `text` starts with; 0 when it is none.
std::size_t utf8_length(std::string_view text);

/// `text` from a file as it may be shown: control characters, which could steer a terminal, and
/// bytes that are not UTF-8 become "\\x1b" and the like.
std::string printable(std::string_view text);

/// " (did you mean 'x'?)" with the candidate nearest to `word` by edit distance, or "" when none
/// is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace sonarsim
