#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>

#include "format/byte_fields.h"
#include "format/sonar_log.h"

namespace sonarsim {

namespace {

// Simrad, "ER60 file format": a datagram is its length, a type of four letters, the time in 100 ns
// since 1601, its content, and its length again. Places are those after the first length.
constexpr std::size_t raw0_data = 84;
constexpr double ns100_per_s = 1e7;
constexpr double s_from_1601_to_1970 = 11644473600.0;
// 10 log10(2) / 256 dB for each step of a sample.
constexpr double db_per_step = 0.011758984205624266;
constexpr double lowest_db = -200.0;

/// A RAW0 datagram with power.
struct EkPing {
    double t_s = 0.0;
    double frequency_hz = 0.0;
    double sample_s = 0.0;
    double sound_speed_m_s = 0.0;
    std::size_t offset = 0;
    std::size_t count = 0;
    std::string_view power;
};

EkPing ek_ping(std::string_view datagram) {
    EkPing ping;
    const double low = field_at<std::uint32_t>(datagram, 4);
    const double high = field_at<std::uint32_t>(datagram, 8);
    ping.t_s = (high * 4294967296.0 + low) / ns100_per_s - s_from_1601_to_1970;
    ping.frequency_hz = field_at<float>(datagram, 20);
    ping.sample_s = field_at<float>(datagram, 36);
    ping.sound_speed_m_s = field_at<float>(datagram, 40);
    const auto offset = field_at<std::int32_t>(datagram, 76);
    const auto count = field_at<std::int32_t>(datagram, 80);
    if (offset < 0 || count < 0 || !(ping.sample_s > 0.0 && ping.sample_s < 1.0) ||
        !(ping.sound_speed_m_s > 0.0 && ping.sound_speed_m_s < fastest_sound_m_s) ||
        !std::isfinite(ping.frequency_hz))
        throw std::runtime_error("has a ping with impossible numbers");
    if ((field_at<std::int16_t>(datagram, 14) & 1) == 0) return ping;  // angles only
    ping.offset = static_cast<std::size_t>(offset);
    ping.count = static_cast<std::size_t>(count);
    if (ping.count > (datagram.size() - raw0_data) / 2)
        throw std::runtime_error("has more samples than their datagram");
    ping.power = datagram.substr(raw0_data, 2 * ping.count);
    return ping;
}

std::vector<EkPing> ek_pings(std::string_view bytes) {
    std::vector<EkPing> pings;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = field_at<std::uint32_t>(bytes, at);
        if (length < 12 || length > bytes.size() - at - 4)
            throw std::runtime_error("has no datagram where one should begin, or is cut off");
        const std::string_view datagram = bytes.substr(at + 4, length);
        if (field_at<std::uint32_t>(bytes, at + 4 + length) != length)
            throw std::runtime_error("has a datagram whose two lengths differ");
        at += length + 8;
        if (!datagram.starts_with("RAW0")) continue;
        const EkPing ping = ek_ping(datagram);
        if (ping.count > 0) pings.push_back(ping);
    }
    if (pings.empty()) throw std::runtime_error("has no power of an EK60 (RAW0 datagrams)");
    return pings;
}

/// The frequency of the channel that is read.
double chosen_frequency(const std::vector<EkPing>& pings, std::optional<double> wanted) {
    std::set<double> all;
    for (const EkPing& ping : pings)
        all.insert(ping.frequency_hz);
    if (!wanted && all.size() == 1) return *all.begin();
    for (const double one : all) {
        if (wanted && std::fabs(one - *wanted) < 1e-3 * one) return one;
    }
    std::string text;
    for (const double one : all)
        text += (text.empty() ? "" : ", ") + std::to_string(std::llround(one));
    throw std::runtime_error("has channels of " + text +
                             " Hz; choose one of them with `frequency_hz`");
}

LoggedPing logged_power(const EkPing& own) {
    LoggedPing ping;
    ping.t_s = own.t_s;
    ping.ranges = static_cast<int>(own.count);
    ping.beams = 1;
    for (std::size_t k = 0; k < own.count; ++k) {
        const double level_db = db_per_step * field_at<std::int16_t>(own.power, 2 * k);
        ping.values.push_back(static_cast<float>(std::max(level_db - lowest_db, 0.0)));
    }
    return ping;
}

}  // namespace

SonarLog read_ek60(std::string_view bytes, std::size_t most_pings,
                   std::optional<double> frequency_hz) {
    const std::vector<EkPing> pings = ek_pings(bytes);
    const double frequency = chosen_frequency(pings, frequency_hz);
    SonarLog log;
    log.kind = LoggedKind::echosounder;
    log.decibels = LoggedDecibels{-lowest_db, -lowest_db};
    log.frequency_hz = frequency;
    const EkPing* first = nullptr;
    for (const EkPing& ping : pings) {
        if (ping.frequency_hz != frequency) continue;
        if (log.pings.size() == most_pings) break;
        if (!first) {
            first = &ping;
            log.range_step_s = ping.sample_s;
            log.first_range_s = static_cast<double>(ping.offset) * ping.sample_s;
            log.sound_speed_m_s = ping.sound_speed_m_s;
        }
        if (ping.count != first->count || ping.offset != first->offset ||
            ping.sample_s != first->sample_s)
            throw std::runtime_error("changes its range; split the file there");
        log.pings.push_back(logged_power(ping));
    }
    return log;
}

}  // namespace sonarsim
