#include "dataset/file_names.h"

#include <algorithm>

namespace sonarsim {

namespace {

constexpr std::size_t longest_name = 255;    // limit of the file systems of Linux
constexpr std::size_t longest_path = 1024;   // more than enough for three names
constexpr std::size_t conversion_bytes = 4;  // length of "%06d"

/// The position of the only number of a pattern; npos if the text is no pattern.
std::size_t find_number(std::string_view text) {
    const std::size_t at = text.find('%');
    const bool sound = at != std::string_view::npos && text.size() >= at + conversion_bytes &&
                       text[at + 1] == '0' && text[at + 2] >= '1' && text[at + 2] <= '9' &&
                       text[at + 3] == 'd' && text.find('/', at) == std::string_view::npos;
    return sound ? at : std::string_view::npos;
}

std::string put_at(std::string_view text, std::size_t at, const std::string& number) {
    std::string whole(text);
    return whole.replace(at, conversion_bytes, number);
}

}  // namespace

bool is_plain_name(std::string_view text) {
    constexpr std::string_view allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.";
    return !text.empty() && text.size() <= longest_name && text.front() != '.' &&
           text.find_first_not_of(allowed) == std::string_view::npos;
}

bool is_inner_path(std::string_view text) {
    if (text.size() > longest_path) return false;
    for (;;) {
        const std::size_t end = text.find('/');
        if (!is_plain_name(text.substr(0, end))) return false;
        if (end == std::string_view::npos) return true;
        text.remove_prefix(end + 1);
    }
}

bool is_pattern(std::string_view text) {
    const std::size_t at = find_number(text);
    return at != std::string_view::npos && is_inner_path(put_at(text, at, "0"));
}

std::string numbered(const std::string& pattern, std::uint64_t number) {
    if (!is_pattern(pattern)) return {};
    const std::size_t at = find_number(pattern);
    std::string text = std::to_string(number);
    const auto digits = static_cast<std::size_t>(pattern[at + 2] - '0');
    text.insert(0, std::max(digits, text.size()) - text.size(), '0');
    return put_at(pattern, at, text);
}

}  // namespace sonarsim
