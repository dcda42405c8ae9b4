#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "core/units.h"
#include "format/byte_fields.h"
#include "format/sonar_log.h"

namespace sonarsim {

namespace {

// Kongsberg, "EM datagrams on *.kmall format", revisions F to I. A datagram begins with 20 bytes:
// its length, its type, version, system, echo sounder, seconds and nanoseconds since 1970. Blocks
// begin with their own length, so that newer fields are skipped.
constexpr std::size_t kmall_header = 20;
constexpr std::size_t kmall_partition = 4;
constexpr std::size_t longest_beam = 65535;
constexpr std::size_t most_values = std::size_t{1} << 28;

/// The samples of one beam: int8 in steps of 0.5 dB.
struct KmallBeam {
    double angle_deg = 0.0;
    std::size_t first = 0;
    std::string_view samples;
};

struct KmallPing {
    double t_s = 0.0;
    double frequency_hz = 0.0;
    double sample_hz = 0.0;
    double sound_speed_m_s = 0.0;
    std::vector<KmallBeam> beams;
    std::size_t ranges = 0;
};

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
void read_beams(std::string_view datagram, std::size_t at, std::size_t rx, KmallPing& ping) {
    const std::size_t count = field_at<std::uint16_t>(datagram, rx + 2);
    const std::size_t entry = field_at<std::uint8_t>(datagram, rx + 4);
    const std::size_t phase = bytes_of_phase(field_at<std::uint8_t>(datagram, rx + 5));
    if (entry < 12) throw std::runtime_error("has beams without their fields");
    for (std::size_t k = 0; k < count; ++k) {
        KmallBeam beam;
        beam.angle_deg = field_at<float>(datagram, at);
        beam.first = field_at<std::uint16_t>(datagram, at + 4);
        const std::size_t samples = field_at<std::uint16_t>(datagram, at + 10);
        if (!(std::fabs(beam.angle_deg) <= 180.0))
            throw std::runtime_error("has a beam without a direction");
        beam.samples = part_of_datagram(datagram, at + entry, samples);
        at += entry + samples * (1 + phase);
        ping.ranges = std::max(ping.ranges, beam.first + samples);
        ping.beams.push_back(beam);
    }
}

KmallPing ping_of_datagram(std::string_view datagram) {
    if (field_at<std::uint16_t>(datagram, kmall_header) > 1)
        throw std::runtime_error("has pings in several partitions, which are not read");
    KmallPing ping;
    ping.t_s = field_at<std::uint32_t>(datagram, 12) + 1e-9 * field_at<std::uint32_t>(datagram, 16);
    const std::size_t common = kmall_header + kmall_partition;
    const std::size_t tx = common + field_at<std::uint16_t>(datagram, common);
    const std::size_t sectors = tx + field_at<std::uint16_t>(datagram, tx);
    const std::size_t sector_count = field_at<std::uint16_t>(datagram, tx + 2);
    if (sector_count > 0) ping.frequency_hz = field_at<float>(datagram, sectors + 4);
    const std::size_t rx = sectors + sector_count * field_at<std::uint16_t>(datagram, tx + 4);
    ping.sample_hz = field_at<float>(datagram, rx + 8);
    ping.sound_speed_m_s = field_at<float>(datagram, rx + 12);
    if (!(ping.sample_hz > 0.0 && ping.sample_hz < 1e9 && ping.sound_speed_m_s > 0.0 &&
          ping.sound_speed_m_s < fastest_sound_m_s))
        throw std::runtime_error("has a ping without a rate of samples or a speed of sound");
    read_beams(datagram, rx + field_at<std::uint16_t>(datagram, rx), rx, ping);
    return ping;
}

/// True for the datagrams that are read: of several receiving fans the first.
bool is_water_column(std::string_view datagram) {
    if (datagram.substr(4, 4) != "#MWC") return false;
    return field_at<std::uint8_t>(datagram, kmall_header + kmall_partition + 5) == 0;
}

LoggedPing logged(const KmallPing& own, std::size_t ranges) {
    LoggedPing ping;
    ping.t_s = own.t_s;
    ping.ranges = static_cast<int>(ranges);
    ping.beams = static_cast<int>(own.beams.size());
    ping.values.assign(ranges * own.beams.size(), 0.0F);
    for (std::size_t j = 0; j < own.beams.size(); ++j) {
        const KmallBeam& beam = own.beams[j];
        for (std::size_t i = 0; i < beam.samples.size(); ++i) {
            // A byte with a sign plus 128.
            const auto level = static_cast<unsigned char>(beam.samples[i]) ^ 0x80U;
            ping.values[(beam.first + i) * own.beams.size() + j] = static_cast<float>(level);
        }
    }
    return ping;
}

}  // namespace

SonarLog read_kmall(std::string_view bytes, std::size_t most_pings) {
    std::vector<KmallPing> pings;
    std::size_t ranges = 0;
    for (std::size_t at = 0; at < bytes.size() && pings.size() < most_pings;) {
        const std::size_t length = field_at<std::uint32_t>(bytes, at);
        if (length < kmall_header)
            throw std::runtime_error("has no datagram where one should begin");
        const std::string_view datagram = part_of_datagram(bytes, at, length);
        at += length;
        if (!is_water_column(datagram)) continue;
        pings.push_back(ping_of_datagram(datagram));
        ranges = std::max(ranges, pings.back().ranges);
    }
    if (pings.empty() || ranges == 0 || ranges > 2 * longest_beam)
        throw std::runtime_error("has no water column (#MWC datagrams)");
    const KmallPing& first = pings.front();
    if (ranges * std::max<std::size_t>(first.beams.size(), 1) > most_values / pings.size())
        throw std::runtime_error("has more than 268,435,456 values; take fewer pings");
    SonarLog log;
    log.decibels = LoggedDecibels{127.5, 255.0};
    log.range_step_s = 1.0 / first.sample_hz;
    log.sound_speed_m_s = first.sound_speed_m_s;
    log.frequency_hz = first.frequency_hz;
    for (const KmallBeam& beam : first.beams)
        log.bearing_rad.push_back(radians(beam.angle_deg));
    for (const KmallPing& ping : pings) {
        if (ping.beams.size() != first.beams.size() ||
            std::fabs(ping.sample_hz - first.sample_hz) > 1e-3 * first.sample_hz)
            throw std::runtime_error(
                "changes its beams or its rate of samples; split the file there");
        log.pings.push_back(logged(ping, ranges));
    }
    return log;
}

}  // namespace sonarsim
