#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sonarsim {

/// Headers with a faster sound are refused as damaged.
inline constexpr double fastest_sound_m_s = 1e4;

struct LoggedPing {
    double t_s = 0.0;  ///< since 1970; 0: not known
    int ranges = 0;
    int beams = 0;
    std::vector<float> values;  ///< [range, beam], the nearest range first
    double bearing_rad = 0.0;   ///< direction of the head of a scanning sonar, positive to port
};

/// A scale of decibels: `range_db` from the value 0 to `full_value`.
struct LoggedDecibels {
    double range_db = 0.0;
    double full_value = 0.0;
};

enum class LoggedKind { imaging, scanning, echosounder };

/// The pings of a file that a sonar's program wrote. All have the same ranges.
struct SonarLog {
    LoggedKind kind = LoggedKind::imaging;
    std::optional<LoggedDecibels> decibels;  ///< the law of the values, if the format defines it
    double first_range_s = 0.0;              ///< two-way travel time of the first sample's middle
    double range_step_s = 0.0;
    double sound_speed_m_s = 0.0;     ///< 0: not known
    double frequency_hz = 0.0;        ///< 0: not known
    std::vector<double> bearing_rad;  ///< bearings of the beams; empty: not known
    std::vector<LoggedPing> pings;
};

/// Reads the first pings of a file. Its bytes show the format: .all, .kmall, .raw of an EK60 or
/// EK80, .ddf, .aris, or a log with messages of a Ping360. `frequency_hz` chooses one of several
/// channels. Throws std::runtime_error with the reason when the file has another format or is
/// damaged.
SonarLog read_sonar_log(std::string_view bytes, std::size_t most_pings,
                        std::optional<double> frequency_hz = {});

/// The water column of a Kongsberg multibeam (#MWC datagrams): amplitudes in steps of 0.5 dB with
/// the TVG of the sonar, 0 for -64 dB. Beams look across the track; their bearings are those of
/// the first ping, from the vertical. Samples that a beam lacks are 0. The first of
/// several fans of a ping is read.
SonarLog read_kmall(std::string_view bytes, std::size_t most_pings);

/// The same for Kongsberg's older format: datagrams 'k' of a .all or .wcd in either byte order. The
/// first of several heads is read; pings that lack a datagram are left out.
SonarLog read_all(std::string_view bytes, std::size_t most_pings);

/// True if a .all begins here.
bool is_all_file(std::string_view bytes);

/// The power of an EK60 (RAW0 datagrams) in dB re 1 W: 200 dB from the value 0 to 200. No TVG.
SonarLog read_ek60(std::string_view bytes, std::size_t most_pings,
                   std::optional<double> frequency_hz);

/// The power of an EK80 (RAW3 datagrams) on the same scale, from int16 samples or complex samples
/// of 16 or 32 bits. Sweeps are compressed by the transmitted pulse after the receiver's filters.
SonarLog read_ek80(std::string_view bytes, std::size_t most_pings,
                   std::optional<double> frequency_hz);

/// The frames of a DIDSON (versions 3 and 4 of its format), 8 bits over 90 dB. Their ranges follow
/// Echoview's formula; the distortion of the lens is not taken out.
SonarLog read_didson(std::string_view bytes, std::size_t most_pings);

/// The frames of an ARIS (version 5 of its format), 8 bits.
SonarLog read_aris(std::string_view bytes, std::size_t most_pings);

/// The messages 2300 and 2301 of a Ping360 among any other bytes, 8 bits.
SonarLog read_ping360(std::string_view bytes, std::size_t most_pings);

}  // namespace sonarsim
