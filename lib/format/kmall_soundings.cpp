#include "format/kmall_soundings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/elementary.h"
#include "core/units.h"
#include "format/kmall_datagrams.h"

namespace sonarsim {

namespace {

// Offsets within the blocks of #MRZ: of the ping, the receiver and a sounding.
constexpr std::size_t lowest_frequency_at = 20, highest_frequency_at = 24, tx_count_at = 92,
                      tx_length_at = 94, speed_at_tx_at = 100, tx_depth_at = 104,
                      water_level_at = 108;
constexpr std::size_t main_count_at = 2, sounding_length_at = 6, class_count_at = 28,
                      class_length_at = 30;
constexpr std::size_t detection_type_at = 3, detection_method_at = 4, reflectivity_at = 52,
                      travel_time_at = 80, depth_at = 96, across_at = 100, shortest_sounding = 120;

void add_sounding(std::string_view entry, double tx_below_m, LoggedSoundings& ping) {
    const bool is_normal = field_at<std::uint8_t>(entry, detection_type_at) == 0;
    if (!is_normal || field_at<std::uint8_t>(entry, detection_method_at) == 0) return;
    const double below = field_at<float>(entry, depth_at) - tx_below_m;
    const double across = field_at<float>(entry, across_at);
    const double level_db = field_at<float>(entry, reflectivity_at);
    const LoggedSounding beam{field_at<float>(entry, travel_time_at),
                              degrees(arctan2(across, below)),
                              std::max(level_db + kmall_sounding_law.range_db, 0.0)};
    const bool is_sound = beam.two_way_s > 0.0 && beam.two_way_s < 100.0 && std::isfinite(below) &&
                          std::isfinite(across) && level_db < 200.0;
    if (!is_sound) throw std::runtime_error("has a sounding with impossible numbers");
    ping.beams.push_back(beam);
}

LoggedSoundings soundings_of(std::string_view datagram) {
    LoggedSoundings ping;
    ping.t_s = kmall_time_s(datagram);
    const std::size_t info = kmall_common + field_at<std::uint16_t>(datagram, kmall_common);
    ping.sound_speed_m_s = field_at<float>(datagram, info + speed_at_tx_at);
    if (!(ping.sound_speed_m_s > 0.0 && ping.sound_speed_m_s < fastest_sound_m_s))
        throw std::runtime_error("has a ping with impossible numbers");
    ping.frequency_hz = 0.5 * (field_at<float>(datagram, info + lowest_frequency_at) +
                               field_at<float>(datagram, info + highest_frequency_at));
    // The depths of soundings and of the water level count from the vessel's reference point, the
    // transmitter's depth from the water level.
    const double tx_below_m = field_at<float>(datagram, info + water_level_at) +
                              field_at<float>(datagram, info + tx_depth_at);
    const std::size_t rx =
        info + field_at<std::uint16_t>(datagram, info) +
        static_cast<std::size_t>(field_at<std::uint16_t>(datagram, info + tx_count_at)) *
            field_at<std::uint16_t>(datagram, info + tx_length_at);
    const std::size_t count = field_at<std::uint16_t>(datagram, rx + main_count_at);
    const std::size_t length = field_at<std::uint16_t>(datagram, rx + sounding_length_at);
    if (length < shortest_sounding) throw std::runtime_error("has soundings without their fields");
    const std::size_t first =
        rx + field_at<std::uint16_t>(datagram, rx) +
        static_cast<std::size_t>(field_at<std::uint16_t>(datagram, rx + class_count_at)) *
            field_at<std::uint16_t>(datagram, rx + class_length_at);
    for (std::size_t k = 0; k < count; ++k)
        add_sounding(part_of_datagram(datagram, first + k * length, length), tx_below_m, ping);
    return ping;
}

}  // namespace

std::vector<LoggedSoundings> read_kmall_soundings(std::string_view bytes, std::size_t most_pings) {
    if (bytes.size() < 8 || bytes[4] != '#')
        throw std::runtime_error("is no .kmall: soundings of other formats are not read");
    std::vector<LoggedSoundings> pings;
    for_each_kmall(bytes, "#MRZ", [&](std::string_view datagram) {
        if (pings.size() < most_pings) pings.push_back(soundings_of(datagram));
        return pings.size() < most_pings;
    });
    if (pings.empty()) throw std::runtime_error("has no soundings (#MRZ datagrams)");
    return pings;
}

}  // namespace sonarsim
