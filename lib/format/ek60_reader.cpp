#include <cstdint>
#include <stdexcept>

#include "format/byte_fields.h"
#include "format/ek_log.h"

namespace sonarsim {

namespace {

// Simrad, "ER60 file format": a datagram is its length, a type of four letters, the time in 100 ns
// since 1601, its content, and its length again. Offsets count from the end of the first length.
constexpr std::size_t raw0_data = 84;

/// Reads a RAW0 datagram; the ping has no samples if the datagram holds only angles.
EkPing ek60_ping_of(std::string_view datagram) {
    EkPing ping;
    ping.t_s = ek_time_s(datagram);
    ping.frequency_hz = field_at<float>(datagram, 20);
    ping.sample_s = field_at<float>(datagram, 36);
    ping.sound_speed_m_s = field_at<float>(datagram, 40);
    check_ek(ping);
    const auto offset = field_at<std::int32_t>(datagram, 76);
    const auto count = field_at<std::int32_t>(datagram, 80);
    if (offset < 0 || count < 0) throw std::runtime_error("has a ping with impossible numbers");
    if ((field_at<std::int16_t>(datagram, 14) & 1) == 0) return ping;
    ping.offset = static_cast<std::size_t>(offset);
    ping.count = static_cast<std::size_t>(count);
    if (ping.count > (datagram.size() - raw0_data) / 2)
        throw std::runtime_error("has more samples than their datagram");
    ping.samples = datagram.substr(raw0_data, 2 * ping.count);
    return ping;
}

}  // namespace

SonarLog read_ek60(std::string_view bytes, std::size_t most_pings,
                   std::optional<double> frequency_hz) {
    std::vector<EkPing> pings;
    for (const std::string_view datagram : ek_datagrams(bytes)) {
        if (!datagram.starts_with("RAW0")) continue;
        const EkPing ping = ek60_ping_of(datagram);
        if (ping.count > 0) pings.push_back(ping);
    }
    if (pings.empty()) throw std::runtime_error("has no power of an EK60 (RAW0 datagrams)");
    return log_of_ek(pings, most_pings, frequency_hz);
}

}  // namespace sonarsim
