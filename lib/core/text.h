#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sonarsim {

/// Parses the whole of `text` as a decimal number ("1", "-2.5e-3", "inf", "nan"); nullopt if
/// anything is left over. Octal, hexadecimal and a locale's comma are not accepted.
std::optional<double> parse_number(std::string_view text);

/// Parses the whole of `text` as a decimal integer; nullopt if it is not one or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// The shortest decimal text that reads back as the same number.
std::string number_text(double value);

/// A few digits and no exponent, as people write a share or a percentage: "0.026", "3", "120".
std::string short_text(double value, int digits = 2);

std::string_view trim(std::string_view text);

/// The text of a file without the UTF-8 byte order mark that some editors put at its start.
std::string_view without_byte_order_mark(std::string_view text);

/// Length of the well-formed UTF-8 character at the start of `text`; 0 if there is none.
std::size_t utf8_length(std::string_view text);

/// Makes `text` from a file safe to print: control characters, which could steer a terminal, and
/// bytes that are not UTF-8 become "\\x1b" and the like.
std::string printable(std::string_view text);

/// "a, b, c".
std::string listed(auto&& texts, std::string_view separator = ", ") {
    std::string out;
    for (const auto& text : texts)
        out.append(out.empty() ? "" : separator).append(text);
    return out;
}

/// True if an element of `all` equals `wanted`.
bool contains(const auto& all, const auto& wanted) {
    return std::ranges::find(all, wanted) != std::ranges::end(all);
}

/// " (did you mean 'x'?)" with the candidate nearest to `word` by edit distance; "": none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// A name without the number that Blender adds to the name of a copy, a point and three or more
/// digits: "Mine" for "Mine.001".
inline std::string without_copy_number(const std::string& name) {
    constexpr std::size_t min_digits = 3;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot == 0 || name.size() - dot - 1 < min_digits) return name;
    const bool digits = name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
    return digits ? name.substr(0, dot) : name;
}

/// The format of a file by its first bytes, as "a .glb mesh", for messages; "": unknown.
std::string_view known_format(std::string_view bytes);

/// True if arrays and objects of a JSON text, valid or not, are nested more than `levels` deep.
/// Recursive functions copy, compare and write a JSON tree: a deep one exhausts the stack.
bool is_nested_deeper(std::string_view text, int levels);

/// Two hexadecimal digits for each byte.
std::string hex_text(std::span<const std::uint8_t> bytes);

// Only letters of ASCII change.
std::string in_lower_case(std::string text);
std::string in_capitals(std::string text);

}  // namespace sonarsim
