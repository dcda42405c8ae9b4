#include "format/ek_log.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "core/elementary.h"
#include "core/units.h"
#include "format/byte_fields.h"
#include "format/ek80_pulse.h"

namespace sonarsim {

namespace {

constexpr double ns100_per_s = 1e7;
constexpr double s_from_1601_to_1970 = 11644473600.0;
// 10 log10(2) / 256 dB for each step of a sample.
constexpr double db_per_step = 0.011758984205624266;
constexpr double lowest_db = -200.0;

/// The frequency of the channel that is read.
double chosen_frequency(const std::vector<EkPing>& pings, std::optional<double> wanted) {
    std::set<double> all;
    for (const EkPing& ping : pings)
        all.insert(ping.frequency_hz);
    if (!wanted && all.size() == 1) return *all.begin();
    for (const double one : all) {
        if (wanted && is_wanted(one, *wanted)) return one;
    }
    std::string text;
    for (const double one : all)
        text += (text.empty() ? "" : ", ") + std::to_string(std::llround(one));
    throw std::runtime_error("has channels of " + text +
                             " Hz; choose one of them with `frequency_hz`");
}

/// A float of 16 bits (IEEE 754).
float half_value(std::uint16_t bits) {
    const int exponent = (bits >> 10) & 31;
    const int fraction = bits & 1023;
    const float size = exponent == 31 ? std::numeric_limits<float>::infinity()
                       : exponent == 0
                           ? std::ldexp(static_cast<float>(fraction), -24)
                           : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
    return (bits >> 15) != 0 ? -size : size;
}

/// The means of the sectors' complex samples, compressed if the pulse is a sweep.
std::vector<std::complex<double>> complex_samples(const EkPing& ping) {
    const auto number = [&](std::size_t k) -> double {
        return ping.has_half_floats ? half_value(field_at<std::uint16_t>(ping.samples, 2 * k))
                                    : field_at<float>(ping.samples, 4 * k);
    };
    const auto sectors = static_cast<std::size_t>(ping.sectors);
    std::vector<std::complex<double>> out(ping.count);
    for (std::size_t k = 0; k < sectors * ping.count; ++k)
        out[k / sectors] +=
            std::complex<double>(number(2 * k), number(2 * k + 1)) / static_cast<double>(sectors);
    return ping.pulse ? compressed(out, *ping.pulse) : out;
}

/// The levels of the samples in dB re 1 W.
std::vector<double> levels_of(const EkPing& ping) {
    std::vector<double> levels;
    if (ping.sectors == 0) {
        for (std::size_t k = 0; k < ping.count; ++k)
            levels.push_back(db_per_step * field_at<std::int16_t>(ping.samples, 2 * k));
        return levels;
    }
    for (const std::complex<double>& sample : complex_samples(ping)) {
        const double power = ping.watts * std::norm(sample);
        if (!std::isfinite(power)) throw std::runtime_error("has samples that are no numbers");
        levels.push_back(power > 0.0 ? db_of_e * logarithm(power) : lowest_db);
    }
    return levels;
}

LoggedPing logged_ek(const EkPing& own) {
    LoggedPing ping;
    ping.t_s = own.t_s;
    ping.ranges = static_cast<int>(own.count);
    ping.beams = 1;
    for (const double level : levels_of(own))
        ping.values.push_back(static_cast<float>(std::max(level - lowest_db, 0.0)));
    return ping;
}

}  // namespace

bool is_wanted(double frequency_hz, double wanted_hz) {
    return std::fabs(frequency_hz - wanted_hz) < 1e-3 * frequency_hz;
}

std::vector<std::string_view> ek_datagrams(std::string_view bytes) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = field_at<std::uint32_t>(bytes, at);
        if (length < 12 || length > bytes.size() - at - 4)
            throw std::runtime_error("has no datagram where one should begin, or is cut off");
        if (field_at<std::uint32_t>(bytes, at + 4 + length) != length)
            throw std::runtime_error("has a datagram whose two lengths differ");
        out.push_back(bytes.substr(at + 4, length));
        at += length + 8;
    }
    return out;
}

double ek_time_s(std::string_view datagram) {
    const double low = field_at<std::uint32_t>(datagram, 4);
    const double high = field_at<std::uint32_t>(datagram, 8);
    return (high * 4294967296.0 + low) / ns100_per_s - s_from_1601_to_1970;
}

void check_ek(const EkPing& ping) {
    if (!(ping.sample_s > 0.0 && ping.sample_s < 1.0) ||
        !(ping.sound_speed_m_s > 0.0 && ping.sound_speed_m_s < fastest_sound_m_s) ||
        !std::isfinite(ping.frequency_hz))
        throw std::runtime_error("has a ping with impossible numbers");
}

SonarLog log_of_ek(const std::vector<EkPing>& pings, std::size_t most_pings,
                   std::optional<double> frequency_hz) {
    const double frequency = chosen_frequency(pings, frequency_hz);
    SonarLog log;
    log.kind = LoggedKind::echosounder;
    log.decibels = LoggedDecibels{-lowest_db, -lowest_db};
    log.frequency_hz = frequency;
    const EkPing* first = nullptr;
    std::size_t products = 0;
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
        if (ping.pulse) add_products(ping.count * ping.pulse->size(), products);
        log.pings.push_back(logged_ek(ping));
    }
    return log;
}

}  // namespace sonarsim
