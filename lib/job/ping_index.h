#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// A field of the journal for a file: its size and its SHA-256 sum.
struct FileEntry {
    std::uint64_t bytes = 0;
    std::string sha256;
};
std::string entry_text(const FileEntry& entry);
/// Nothing if the text is no such entry.
std::optional<FileEntry> parse_entry(std::string_view text);

/// The fields of the journal by ping. A mission may have millions of pings: an entry of a file
/// takes 41 bytes here, and a ping 17 bytes more.
class PingIndex {
  public:
    /// A ping that is added twice keeps the last fields. Call sort() before the other functions.
    void add(const PingId& ping, const std::vector<std::string>& fields);
    void sort();

    /// Nothing for a ping that was not added.
    std::optional<std::vector<std::string>> find(const PingId& ping) const;

    std::size_t size() const { return entries_.size(); }
    std::size_t bytes() const { return packed_.size() + entries_.size() * sizeof(Entry); }

    /// Calls `visit` with every ping and its fields, in the order of the pings.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const Entry& entry : entries_)
            visit(entry.ping, unpacked(entry.begin));
    }

  private:
    struct Entry {
        PingId ping;
        std::uint64_t begin;  ///< index into `packed_`
    };

    std::vector<std::string> unpacked(std::uint64_t begin) const;

    std::vector<Entry> entries_;
    std::string packed_;
};

}  // namespace sonarsim
