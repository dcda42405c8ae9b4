#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "format/byte_fields.h"
#include "format/sonar_log.h"

namespace sonarsim {

namespace {

// Sound Metrics, DIDSON file format, versions 3 and 4: a header of the file, then frames, each a
// header and its samples [sample, beam], 8 bits. The two versions differ in the lengths of headers.
constexpr std::uint32_t version_3 = 0x03464444, version_4 = 0x04464444;
constexpr std::size_t didson_resolution_at = 12, didson_beams_at = 16, didson_rate_at = 20,
                      didson_samples_at = 24, didson_serial_at = 44;
constexpr std::size_t frame_version_at = 12, frame_date_at = 20, window_start_at = 52,
                      config_flags_at = 192;
constexpr std::uint32_t most_didson_samples = 65536;
// Echoview, "DIDSON data files": the begin of the window counts these periods; values span 90 dB.
constexpr double classic_period_s = 0.000512, extended_period_s = 0.000572;
constexpr double didson_range_db = 90.0;
constexpr int last_classic_serial = 18;
constexpr double most_periods = 1000.0;

/// The header of the file, which holds for all frames.
struct DidsonFile {
    std::uint32_t version = 0;
    bool is_fine = false;  ///< the higher of the two frequencies
    int beams = 0;
    int samples = 0;
    double rate_hz = 0.0;
    int serial = 0;

    std::size_t file_header() const { return version == version_3 ? 512 : 1024; }
    std::size_t frame_header() const { return version == version_3 ? 256 : 1024; }
};

DidsonFile didson_file(std::string_view bytes) {
    DidsonFile file;
    file.version = field_at<std::uint32_t>(bytes, 0);
    if (file.version != version_3 && file.version != version_4)
        throw std::runtime_error("is version " + std::to_string(file.version >> 24U) +
                                 " of DIDSON's format; versions 3, 4 and 5 are read");
    file.is_fine = field_at<std::int32_t>(bytes, didson_resolution_at) != 0;
    file.beams = field_at<std::int32_t>(bytes, didson_beams_at);
    file.samples = field_at<std::int32_t>(bytes, didson_samples_at);
    file.rate_hz = field_at<float>(bytes, didson_rate_at);
    file.serial = field_at<std::int32_t>(bytes, didson_serial_at);
    if ((file.beams != 48 && file.beams != 96) || file.samples <= 0 ||
        file.samples > static_cast<int>(most_didson_samples))
        throw std::runtime_error("has " + std::to_string(file.beams) + " beams and " +
                                 std::to_string(file.samples) + " samples, which no DIDSON has");
    if (!(file.rate_hz > 0.0 && file.rate_hz < 1e9))
        throw std::runtime_error("has no rate of samples");
    return file;
}

/// Seconds since 1970, by the clock of the computer that recorded.
double time_of_frame(std::string_view frame) {
    using namespace std::chrono;
    int fields[7];
    for (std::size_t k = 0; k < 7; ++k)
        fields[k] = field_at<std::int32_t>(frame, frame_date_at + 4 * k);
    const year_month_day day(year(fields[0]), month(static_cast<unsigned>(fields[1])),
                             std::chrono::day(static_cast<unsigned>(fields[2])));
    if (fields[0] < 1970 || fields[0] > 9999 || !day.ok())
        throw std::runtime_error("has a frame without a date");
    const double days = static_cast<double>(sys_days(day).time_since_epoch().count());
    return ((days * 24.0 + fields[3]) * 60.0 + fields[4]) * 60.0 + fields[5] + 0.01 * fields[6];
}

/// The two-way travel time of the middle of the first sample.
double first_sample_s(std::string_view frame, const DidsonFile& file) {
    const bool is_classic = file.serial <= last_classic_serial ||
                            (field_at<std::int32_t>(frame, config_flags_at) & 1) != 0;
    const double periods = field_at<std::int32_t>(frame, window_start_at);
    if (!(periods >= 0.0 && periods < most_periods))
        throw std::runtime_error("has a frame without a window of range");
    const double period_s = is_classic ? classic_period_s : extended_period_s;
    return (file.is_fine ? 1.0 : 2.0) * period_s * periods + 0.5 / file.rate_hz;
}

LoggedPing didson_frame(std::string_view frame, const DidsonFile& file) {
    if (field_at<std::uint32_t>(frame, frame_version_at) != file.version)
        throw std::runtime_error("has a frame of another version");
    LoggedPing ping;
    ping.t_s = time_of_frame(frame);
    ping.ranges = file.samples;
    ping.beams = file.beams;
    for (const char value : frame.substr(file.frame_header()))
        ping.values.push_back(static_cast<unsigned char>(value));
    return ping;
}

}  // namespace

SonarLog read_didson(std::string_view bytes, std::size_t most_pings) {
    const DidsonFile file = didson_file(bytes);
    const std::size_t length = file.frame_header() + static_cast<std::size_t>(file.beams) *
                                                         static_cast<std::size_t>(file.samples);
    SonarLog log;
    log.decibels = LoggedDecibels{didson_range_db, 255.0};
    log.range_step_s = 1.0 / file.rate_hz;
    for (std::size_t at = file.file_header(); at < bytes.size() && log.pings.size() < most_pings;
         at += length) {
        if (bytes.size() - at < length) throw std::runtime_error("is cut off within a frame");
        const std::string_view frame = bytes.substr(at, length);
        log.pings.push_back(didson_frame(frame, file));
        const double first_s = first_sample_s(frame, file);
        if (log.pings.size() == 1) log.first_range_s = first_s;
        if (first_s != log.first_range_s)
            throw std::runtime_error("changes its range; split the file there");
    }
    if (log.pings.empty()) throw std::runtime_error("has no frames");
    return log;
}

}  // namespace sonarsim
