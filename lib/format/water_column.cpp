#include "format/water_column.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.h"

namespace sonarsim {

namespace {

constexpr std::size_t longest_beam = 65535;
constexpr std::size_t most_values = std::size_t{1} << 28;
// Real beams begin near the sonar, so that the padded fan has only a few times their samples.
constexpr std::size_t most_values_per_sample = 64;

LoggedPing logged_water(const WaterPing& own, std::size_t ranges) {
    LoggedPing ping;
    ping.t_s = own.t_s;
    ping.ranges = static_cast<int>(ranges);
    ping.beams = static_cast<int>(own.beams.size());
    ping.values.assign(ranges * own.beams.size(), 0.0F);
    for (std::size_t j = 0; j < own.beams.size(); ++j) {
        const WaterBeam& beam = own.beams[j];
        for (std::size_t i = 0; i < beam.samples.size(); ++i) {
            // An int8 plus 128.
            const auto level = static_cast<unsigned char>(beam.samples[i]) ^ 0x80U;
            ping.values[(beam.first + i) * own.beams.size() + j] = static_cast<float>(level);
        }
    }
    return ping;
}

}  // namespace

void WaterPing::add(const WaterBeam& beam) {
    if (!(std::fabs(beam.angle_deg) <= 180.0))
        throw std::runtime_error("has a beam without a direction");
    beams.push_back(beam);
}

void check_water(const WaterPing& ping) {
    if (!(ping.sample_hz > 0.0 && ping.sample_hz < 1e9 && ping.sound_speed_m_s > 0.0 &&
          ping.sound_speed_m_s < fastest_sound_m_s))
        throw std::runtime_error("has a ping without a rate of samples or a speed of sound");
}

SonarLog log_of_water(const std::vector<WaterPing>& pings, const char* missing) {
    std::size_t ranges = 0;
    std::size_t samples = 0;
    for (const WaterPing& ping : pings) {
        for (const WaterBeam& beam : ping.beams) {
            ranges = std::max(ranges, beam.first + beam.samples.size());
            samples += beam.samples.size();
        }
    }
    if (pings.empty() || ranges == 0 || ranges > 2 * longest_beam)
        throw std::runtime_error(missing);
    const WaterPing& first = pings.front();
    const std::size_t values = ranges * std::max<std::size_t>(first.beams.size(), 1);
    if (values > most_values / pings.size())
        throw std::runtime_error("has more than 268,435,456 values; take fewer pings");
    if (values * pings.size() > most_values_per_sample * samples)
        throw std::runtime_error("has beams that begin far beyond their few samples");
    SonarLog log;
    log.decibels = LoggedDecibels{127.5, 255.0};
    log.range_step_s = 1.0 / first.sample_hz;
    log.sound_speed_m_s = first.sound_speed_m_s;
    log.frequency_hz = first.frequency_hz;
    for (const WaterBeam& beam : first.beams)
        log.bearing_rad.push_back(radians(beam.angle_deg));
    for (const WaterPing& ping : pings) {
        if (ping.beams.size() != first.beams.size() ||
            std::fabs(ping.sample_hz - first.sample_hz) > 1e-3 * first.sample_hz)
            throw std::runtime_error(
                "changes its beams or its rate of samples; split the file there");
        log.pings.push_back(logged_water(ping, ranges));
    }
    return log;
}

}  // namespace sonarsim
