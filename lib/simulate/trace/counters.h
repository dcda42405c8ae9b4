#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sonarsim {

// The counters and times of a ping. A stage owns a member of one of the structs and a line of the
// table below it; sums, metadata and log lines follow from the tables.

/// The numbers of a ping's samples by the outcome of their multipath.
struct MultipathCounts {
    std::uint64_t samples = 0;
    std::uint64_t clusters = 0;
    std::uint64_t rays = 0;
    std::uint64_t bounces = 0;
    std::uint64_t missed = 0;
    std::uint64_t edge_on = 0;
    std::uint64_t behind = 0;
    std::uint64_t outside = 0;
    std::uint64_t turned_away = 0;
    std::uint64_t hidden = 0;
};

struct PingCounts {
    std::uint64_t samples = 0;
    std::uint64_t dropped_samples = 0;
    std::uint64_t echoes = 0;
    std::uint64_t out_of_range = 0;
    std::uint64_t occupied_bins = 0;
    std::uint64_t negative_pixels = 0;
    std::uint64_t streak_rows = 0;
    MultipathCounts multipath;
};

/// Seconds spent in the stages of a ping.
struct PingSeconds {
    double trace = 0.0;
    double multipath = 0.0;
    double accumulate = 0.0;
    double noise = 0.0;
};

/// One number of a struct.
template <class Struct, class Number>
struct Statistic {
    std::string_view name;  ///< in the metadata
    Number Struct::*member;
    std::string_view text;   ///< the counted items or the timed step; follows the number
    bool is_a_loss = false;  ///< something is missing from the image: worth a line in the log
};

template <class Struct, class Number>
Statistic(const char*, Number Struct::*, const char*, bool = false) -> Statistic<Struct, Number>;

inline constexpr std::array multipath_counters{
    Statistic{"samples", &MultipathCounts::samples, "samples within the range"},
    Statistic{"clusters", &MultipathCounts::clusters, "clusters of them"},
    Statistic{"rays", &MultipathCounts::rays, "rays traced for them, and back to the sonar"},
    Statistic{"bounces", &MultipathCounts::bounces, "samples whose sound came back"},
    Statistic{"missed", &MultipathCounts::missed, "met no second surface"},
    Statistic{"edge_on", &MultipathCounts::edge_on, "ran along the second plane"},
    Statistic{"behind", &MultipathCounts::behind, "left the second plane"},
    Statistic{"outside", &MultipathCounts::outside, "met it out of view or of range"},
    Statistic{"turned_away", &MultipathCounts::turned_away, "were reflected away from the sonar"},
    Statistic{"hidden", &MultipathCounts::hidden, "met what the sonar does not see"},
};

inline constexpr std::array ping_counters{
    Statistic{"samples", &PingCounts::samples, "pieces of surface seen"},
    Statistic{"dropped_samples", &PingCounts::dropped_samples,
              "pieces of surface left out: edge-on, at no distance, or lost in rounding", true},
    Statistic{"echoes", &PingCounts::echoes, "footprints added into bins"},
    Statistic{"out_of_range", &PingCounts::out_of_range,
              "footprints dropped: wholly outside the range", true},
    Statistic{"occupied_bins", &PingCounts::occupied_bins, "bins that saw surface"},
    Statistic{"negative_pixels", &PingCounts::negative_pixels,
              "pixels set to 0: negative after the noise", true},
    Statistic{"streak_rows", &PingCounts::streak_rows, "range rows changed by a streak"},
};

inline constexpr std::array ping_timers{
    Statistic{"trace", &PingSeconds::trace, "s to find the visible surface"},
    Statistic{"multipath", &PingSeconds::multipath, "s to find multipath"},
    Statistic{"accumulate", &PingSeconds::accumulate, "s for echoes, range noise and bins"},
    Statistic{"noise", &PingSeconds::noise, "s for pixel noise and streaks"},
};

template <class Struct, class Number, std::size_t n>
void add(const std::array<Statistic<Struct, Number>, n>& table, Struct& sum, const Struct& values) {
    for (const auto& statistic : table)
        sum.*statistic.member += values.*statistic.member;
}

inline PingCounts& operator+=(PingCounts& sum, const PingCounts& counts) {
    add(ping_counters, sum, counts);
    add(multipath_counters, sum.multipath, counts.multipath);
    return sum;
}

/// Divides every count and rounds it up, so that only 0 becomes 0.
inline void divide(PingCounts& counts, std::uint64_t by) {
    for (const auto& counter : ping_counters)
        counts.*counter.member = (counts.*counter.member + by - 1) / by;
    for (const auto& counter : multipath_counters)
        counts.multipath.*counter.member = (counts.multipath.*counter.member + by - 1) / by;
}

inline PingSeconds& operator+=(PingSeconds& sum, const PingSeconds& seconds) {
    add(ping_timers, sum, seconds);
    return sum;
}

/// A JSON object with a member for every line, in the order of the table.
template <class Json, class Struct, class Number, std::size_t n>
Json json_object(const std::array<Statistic<Struct, Number>, n>& table, const Struct& values) {
    Json json = Json::object();
    for (const auto& statistic : table)
        json[std::string(statistic.name)] = values.*statistic.member;
    return json;
}

/// "7 of this, 2 of that": every line, in the order of the table.
template <class Struct, class Number, std::size_t n>
std::string sentence(const std::array<Statistic<Struct, Number>, n>& table, const Struct& values) {
    std::string text;
    for (const auto& statistic : table) {
        text += (text.empty() ? "" : ", ") + std::to_string(values.*statistic.member) + " ";
        text += statistic.text;
    }
    return text;
}

}  // namespace sonarsim
