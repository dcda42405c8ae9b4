#include "job/told_pings.h"

#include <algorithm>
#include <cstring>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t sum_bytes = 32;
constexpr std::string_view digits = "0123456789abcdef";

/// Words that are packed as a number and a sum, or as they are after their length.
enum class WordKind : char { text, entry };

template <class T>
void put(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T take(std::string_view& rest) {
    T value;
    std::memcpy(&value, rest.data(), sizeof value);
    rest.remove_prefix(sizeof value);
    return value;
}

/// Whether the word says again what is packed of it.
bool is_plain_entry(const std::string& word) {
    const auto entry = parse_entry(word);
    return entry && entry->sha256.size() == 2 * sum_bytes &&
           entry->sha256.find_first_not_of(digits) == std::string::npos &&
           entry_text(*entry) == word;
}

void put_entry(std::string& out, const FileEntry& entry) {
    put(out, entry.bytes);
    for (std::size_t k = 0; k < entry.sha256.size(); k += 2) {
        out +=
            static_cast<char>(digits.find(entry.sha256[k]) << 4 | digits.find(entry.sha256[k + 1]));
    }
}

FileEntry take_entry(std::string_view& rest) {
    FileEntry entry{take<std::uint64_t>(rest), {}};
    for (const char c : rest.substr(0, sum_bytes)) {
        const auto byte = static_cast<unsigned char>(c);
        entry.sha256 += digits[byte >> 4];
        entry.sha256 += digits[byte & 15U];
    }
    rest.remove_prefix(sum_bytes);
    return entry;
}

}  // namespace

std::string entry_text(const FileEntry& entry) {
    return std::to_string(entry.bytes) + ':' + entry.sha256;
}

std::optional<FileEntry> parse_entry(std::string_view text) {
    const std::size_t colon = text.find(':');
    const auto bytes = parse_unsigned(text.substr(0, colon));
    if (colon == std::string_view::npos || !bytes) return std::nullopt;
    return FileEntry{*bytes, std::string(text.substr(colon + 1))};
}

void ToldPings::add(const PingId& ping, const std::vector<std::string>& words) {
    places_.push_back({ping, packed_.size()});
    put(packed_, static_cast<std::uint32_t>(words.size()));
    for (const std::string& word : words) {
        const bool entry = is_plain_entry(word);
        put(packed_, entry ? WordKind::entry : WordKind::text);
        if (entry) {
            put_entry(packed_, *parse_entry(word));
        } else {
            put(packed_, static_cast<std::uint32_t>(word.size()));
            packed_ += word;
        }
    }
}

void ToldPings::sort() {
    // The last of those of one ping comes first, and `unique` keeps it.
    std::ranges::sort(places_, [](const Place& a, const Place& b) {
        return a.ping != b.ping ? a.ping < b.ping : a.begin > b.begin;
    });
    const auto same = [](const Place& a, const Place& b) { return a.ping == b.ping; };
    places_.erase(std::unique(places_.begin(), places_.end(), same), places_.end());
}

std::optional<std::vector<std::string>> ToldPings::find(const PingId& ping) const {
    const auto place = std::ranges::lower_bound(places_, ping, {}, &Place::ping);
    if (place == places_.end() || place->ping != ping) return std::nullopt;
    return unpacked(place->begin);
}

std::vector<std::string> ToldPings::unpacked(std::uint64_t begin) const {
    std::string_view rest = std::string_view(packed_).substr(begin);
    std::vector<std::string> words(take<std::uint32_t>(rest));
    for (std::string& word : words) {
        if (take<WordKind>(rest) == WordKind::entry) {
            word = entry_text(take_entry(rest));
        } else {
            const auto size = take<std::uint32_t>(rest);
            word = rest.substr(0, size);
            rest.remove_prefix(size);
        }
    }
    return words;
}

}  // namespace sonarsim
