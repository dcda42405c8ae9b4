#include "job/ping_index.h"

#include <algorithm>
#include <cstring>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t sum_bytes = 32;
constexpr std::string_view digits = "0123456789abcdef";

/// An entry of a file is packed as its size and sum, other fields as their length and text.
enum class FieldKind : char { text, entry };

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

/// True if packing and unpacking gives the same field again.
bool is_plain_entry(const std::string& field) {
    const auto entry = parse_entry(field);
    return entry && entry->sha256.size() == 2 * sum_bytes &&
           entry->sha256.find_first_not_of(digits) == std::string::npos &&
           entry_text(*entry) == field;
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

void PingIndex::add(const PingId& ping, const std::vector<std::string>& fields) {
    entries_.push_back({ping, packed_.size()});
    put(packed_, static_cast<std::uint32_t>(fields.size()));
    for (const std::string& field : fields) {
        const bool entry = is_plain_entry(field);
        put(packed_, entry ? FieldKind::entry : FieldKind::text);
        if (entry) {
            put_entry(packed_, *parse_entry(field));
        } else {
            put(packed_, static_cast<std::uint32_t>(field.size()));
            packed_ += field;
        }
    }
}

void PingIndex::sort() {
    // The last entry added for a ping is sorted before the ping's other entries; `unique` keeps it.
    std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
        return a.ping != b.ping ? a.ping < b.ping : a.begin > b.begin;
    });
    const auto same = [](const Entry& a, const Entry& b) { return a.ping == b.ping; };
    entries_.erase(std::unique(entries_.begin(), entries_.end(), same), entries_.end());
}

std::optional<std::vector<std::string>> PingIndex::find(const PingId& ping) const {
    const auto found = std::ranges::lower_bound(entries_, ping, {}, &Entry::ping);
    if (found == entries_.end() || found->ping != ping) return std::nullopt;
    return unpacked(found->begin);
}

std::vector<std::string> PingIndex::unpacked(std::uint64_t begin) const {
    std::string_view rest = std::string_view(packed_).substr(begin);
    std::vector<std::string> fields(take<std::uint32_t>(rest));
    for (std::string& field : fields) {
        if (take<FieldKind>(rest) == FieldKind::entry) {
            field = entry_text(take_entry(rest));
        } else {
            const auto size = take<std::uint32_t>(rest);
            field = rest.substr(0, size);
            rest.remove_prefix(size);
        }
    }
    return fields;
}

}  // namespace sonarsim
