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

/// " (did you mean 'x'?)" with the candidate nearest to `word` by edit distance, or "" when none
/// is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace sonarsim
