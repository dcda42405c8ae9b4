#include "gallery/content_policy.h"

#include <cstdint>

#include "core/sha256.h"

namespace sonarsim {

namespace {

/// The bytes of hexadecimal digits, as base64.
std::string base64_of(const std::string& hex) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    std::uint32_t bits = 0;
    int waiting = 0;  // bits that are not written yet
    for (const char digit : hex) {
        bits =
            bits << 4 | static_cast<std::uint32_t>(std::stoi(std::string(1, digit), nullptr, 16));
        waiting += 4;
        if (waiting < 6) continue;
        waiting -= 6;
        text += digits[bits >> waiting & 63U];
    }
    if (waiting > 0) text += digits[bits << (6 - waiting) & 63U];
    text.append((4 - text.size() % 4) % 4, '=');
    return text;
}

/// The browser hashes all text between the tags.
std::string source_of(std::string_view page, std::string_view begin, std::string_view end) {
    const std::size_t at = page.find(begin) + begin.size();
    return "'sha256-" + base64_of(sha256(page.substr(at, page.find(end, at) - at))) + "'";
}

}  // namespace

std::string content_policy(std::string_view page) {
    // For a page that is opened from a disk, some browsers match nothing with 'self'.
    return "default-src 'none'; style-src " + source_of(page, "<style>", "</style>") +
           "; script-src " + source_of(page, "<script>", "</script>") +
           "; img-src 'self' file:; base-uri 'none'; form-action 'none'";
}

}  // namespace sonarsim
