#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "format/byte_fields.h"
#include "format/sonar_log.h"

namespace sonarsim {

namespace {

// Sound Metrics, ARIS file format, version 5 of the DIDSON format: a header of 1,024 bytes, then
// frames, each a header of 1,024 bytes and its samples [sample, beam], 8 bits.
constexpr std::uint32_t version_5 = 0x05464444;
constexpr std::size_t aris_header = 1024;
constexpr std::size_t file_beams_at = 16, file_samples_at = 24;
constexpr std::size_t time_at = 20, sample_period_at = 452, sound_speed_at = 464, samples_at = 468,
                      start_delay_at = 476, ordered_at = 516;
constexpr std::array<std::uint32_t, 4> beam_counts{48, 64, 96, 128};
constexpr std::uint32_t most_samples = 65536;

/// Reads a frame. Throws std::runtime_error unless it agrees with the header of the file.
LoggedPing aris_frame(std::string_view frame, std::uint32_t samples, std::uint32_t beams) {
    if (field_at<std::uint32_t>(frame, 12) != version_5)
        throw std::runtime_error("has a frame of another version");
    if (field_at<std::uint32_t>(frame, samples_at) != samples)
        throw std::runtime_error("changes its number of samples; split the file there");
    if (field_at<std::uint32_t>(frame, ordered_at) != 1)
        throw std::runtime_error(
            "has samples that are not in the order of the beams; save it again with ARIScope");
    LoggedPing ping;
    ping.t_s = 1e-6 * static_cast<double>(field_at<std::uint64_t>(frame, time_at));
    ping.ranges = static_cast<int>(samples);
    ping.beams = static_cast<int>(beams);
    for (const char value : frame.substr(aris_header))
        ping.values.push_back(static_cast<unsigned char>(value));
    return ping;
}

}  // namespace

SonarLog read_aris(std::string_view bytes, std::size_t most_pings) {
    const auto beams = field_at<std::uint32_t>(bytes, file_beams_at);
    const auto samples = field_at<std::uint32_t>(bytes, file_samples_at);
    bool is_known = false;
    for (const std::uint32_t count : beam_counts)
        is_known = is_known || beams == count;
    if (!is_known || samples == 0 || samples > most_samples)
        throw std::runtime_error("has " + std::to_string(beams) + " beams and " +
                                 std::to_string(samples) + " samples, which no ARIS has");
    const std::size_t length =
        aris_header + static_cast<std::size_t>(beams) * static_cast<std::size_t>(samples);
    SonarLog log;
    for (std::size_t at = aris_header; at < bytes.size() && log.pings.size() < most_pings;
         at += length) {
        if (bytes.size() - at < length) throw std::runtime_error("is cut off within a frame");
        const std::string_view frame = bytes.substr(at, length);
        log.pings.push_back(aris_frame(frame, samples, beams));
        const double step_s = 1e-6 * field_at<std::uint32_t>(frame, sample_period_at);
        const double first_s = 1e-6 * field_at<std::uint32_t>(frame, start_delay_at) + 0.5 * step_s;
        if (log.pings.size() == 1) {
            log.range_step_s = step_s;
            log.first_range_s = first_s;
            log.sound_speed_m_s = field_at<float>(frame, sound_speed_at);
            if (!(step_s > 0.0 && log.sound_speed_m_s > 0.0 &&
                  log.sound_speed_m_s < fastest_sound_m_s))
                throw std::runtime_error("has a frame without a step of range");
        }
        if (step_s != log.range_step_s || first_s != log.first_range_s)
            throw std::runtime_error("changes its range; split the file there");
    }
    if (log.pings.empty()) throw std::runtime_error("has no frames");
    return log;
}

}  // namespace sonarsim
