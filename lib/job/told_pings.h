#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// What the journal says of a ping's file.
struct FileEntry {
    std::uint64_t bytes = 0;
    std::string sha256;
};
std::string entry_text(const FileEntry& entry);
/// Nothing when the text is no such entry.
std::optional<FileEntry> parse_entry(std::string_view text);

/// Words of the journal by ping. A mission may have millions of pings: an entry of a file takes 41
/// bytes here, and a ping 17 besides.
class ToldPings {
  public:
    /// Of what is added for one ping the last counts. Nothing is found before `sort`.
    void add(const PingId& ping, const std::vector<std::string>& words);
    void sort();

    /// Nothing for a ping that was not added.
    std::optional<std::vector<std::string>> find(const PingId& ping) const;

    std::size_t size() const { return places_.size(); }
    std::size_t bytes() const { return packed_.size() + places_.size() * sizeof(Place); }

    /// Calls `visit` with every ping and its words, in the order of the pings.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const Place& place : places_)
            visit(place.ping, unpacked(place.begin));
    }

  private:
    struct Place {
        PingId ping;
        std::uint64_t begin;  ///< in `packed_`
    };

    std::vector<std::string> unpacked(std::uint64_t begin) const;

    std::vector<Place> places_;
    std::string packed_;
};

}  // namespace sonarsim
