#include <cstdint>
#include <stdexcept>

#include "format/kmall_datagrams.h"
#include "format/water_column.h"

namespace sonarsim {

namespace {

std::size_t bytes_of_phase(int flag) {
    if (flag == 0) return 0;
    if (flag == 1 || flag == 2) return static_cast<std::size_t>(flag);
    throw std::runtime_error("has phases of no known size");
}

/// The beams, whose entries follow each other from `at` on.
void read_beams(std::string_view datagram, std::size_t at, std::size_t rx, WaterPing& ping) {
    const std::size_t count = field_at<std::uint16_t>(datagram, rx + 2);
    const std::size_t entry = field_at<std::uint8_t>(datagram, rx + 4);
    const std::size_t phase = bytes_of_phase(field_at<std::uint8_t>(datagram, rx + 5));
    if (entry < 12) throw std::runtime_error("has beams without their fields");
    for (std::size_t k = 0; k < count; ++k) {
        WaterBeam beam;
        beam.angle_deg = field_at<float>(datagram, at);
        beam.first = field_at<std::uint16_t>(datagram, at + 4);
        const std::size_t samples = field_at<std::uint16_t>(datagram, at + 10);
        beam.samples = part_of_datagram(datagram, at + entry, samples);
        at += entry + samples * (1 + phase);
        ping.add(beam);
    }
}

WaterPing ping_of_datagram(std::string_view datagram) {
    WaterPing ping;
    ping.t_s = kmall_time_s(datagram);
    const std::size_t tx = kmall_common + field_at<std::uint16_t>(datagram, kmall_common);
    const std::size_t sectors = tx + field_at<std::uint16_t>(datagram, tx);
    const std::size_t sector_count = field_at<std::uint16_t>(datagram, tx + 2);
    if (sector_count > 0) ping.frequency_hz = field_at<float>(datagram, sectors + 4);
    const std::size_t rx = sectors + sector_count * field_at<std::uint16_t>(datagram, tx + 4);
    ping.sample_hz = field_at<float>(datagram, rx + 8);
    ping.sound_speed_m_s = field_at<float>(datagram, rx + 12);
    check_water(ping);
    read_beams(datagram, rx + field_at<std::uint16_t>(datagram, rx), rx, ping);
    return ping;
}

}  // namespace

SonarLog read_kmall(std::string_view bytes, std::size_t most_pings) {
    std::vector<WaterPing> pings;
    for_each_kmall(bytes, "#MWC", [&](std::string_view datagram) {
        if (pings.size() < most_pings) pings.push_back(ping_of_datagram(datagram));
        return pings.size() < most_pings;
    });
    return log_of_water(pings, "has no water column (#MWC datagrams)");
}

}  // namespace sonarsim
