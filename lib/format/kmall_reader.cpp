#include <cstdint>
#include <stdexcept>

#include "format/byte_fields.h"
#include "format/water_column.h"

namespace sonarsim {

namespace {

// Kongsberg, "EM datagrams on *.kmall format", revisions F to I. A datagram begins with 20 bytes:
// its length, its type, version, system, echo sounder, seconds and nanoseconds since 1970. Blocks
// begin with their own length, so that newer fields are skipped.
constexpr std::size_t kmall_header = 20;
constexpr std::size_t kmall_partition = 4;

std::string_view part_of_datagram(std::string_view bytes, std::size_t at, std::size_t length) {
    if (at > bytes.size() || bytes.size() - at < length)
        throw std::runtime_error("has a datagram that is cut off");
    return bytes.substr(at, length);
}

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
    if (field_at<std::uint16_t>(datagram, kmall_header) > 1)
        throw std::runtime_error("has pings in several partitions, which are not read");
    WaterPing ping;
    ping.t_s = field_at<std::uint32_t>(datagram, 12) + 1e-9 * field_at<std::uint32_t>(datagram, 16);
    const std::size_t common = kmall_header + kmall_partition;
    const std::size_t tx = common + field_at<std::uint16_t>(datagram, common);
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

/// True for the datagrams that are read: of several receiving fans the first.
bool is_water_column(std::string_view datagram) {
    if (datagram.substr(4, 4) != "#MWC") return false;
    return field_at<std::uint8_t>(datagram, kmall_header + kmall_partition + 5) == 0;
}

}  // namespace

SonarLog read_kmall(std::string_view bytes, std::size_t most_pings) {
    std::vector<WaterPing> pings;
    for (std::size_t at = 0; at < bytes.size() && pings.size() < most_pings;) {
        const std::size_t length = field_at<std::uint32_t>(bytes, at);
        if (length < kmall_header)
            throw std::runtime_error("has no datagram where one should begin");
        const std::string_view datagram = part_of_datagram(bytes, at, length);
        at += length;
        if (is_water_column(datagram)) pings.push_back(ping_of_datagram(datagram));
    }
    return log_of_water(pings, "has no water column (#MWC datagrams)");
}

}  // namespace sonarsim
