#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mission/place.h"
#include "recording/recording.h"

namespace sonarsim {

// recording.yaml, which describes a folder of arrays (docs/compare.md). Names are the keys.

enum class BearingSpread { angle, sine };

/// Files of soundings, each [ping, beam]; NaN where a beam has none.
struct SoundingFiles {
    std::filesystem::path range_m;
    std::filesystem::path angle_rad;
    std::filesystem::path intensity;
};

struct RecordingFile {
    RecordedKind kind = RecordedKind::imaging;
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::path> xtf;     ///< in place of `files` or `soundings`
    std::vector<std::filesystem::path> oculus;  ///< an Oculus's, in place of `files` and ranges
    std::vector<std::filesystem::path> logs;    ///< files of read_sonar_log(); the same
    std::optional<SoundingFiles> soundings;
    std::optional<RecordedLaw> law;  ///< missing: the format of `logs` defines it
    double sound_speed_m_s = 0;
    double first_range_m = 0;
    double range_step_m = 0;
    double bearing_first_deg = 0;
    double bearing_last_deg = 0;
    BearingSpread spread = BearingSpread::angle;
    std::vector<double> bearings_deg;  ///< in place of first, last and spread
    double head_first_deg = 0;         ///< a scanning sonar's first direction
    double head_step_deg = 0;
    std::optional<double> frequency_hz;
    std::optional<double> altitude_m;
    std::optional<double> pitch_deg;
    double rate_hz = 0;
    std::vector<double> times_s;  ///< in place of rate_hz
    MissionPlace place;
};

/// The name of the file in the folder of a recording.
inline constexpr const char* recording_file_name = "recording.yaml";

/// Reads recording.yaml. Paths start at `folder`. InputError with the place of each fault.
RecordingFile parse_recording(std::string_view text, const std::string& source,
                              const std::filesystem::path& folder);

/// The names of the kinds: "imaging", ...
const char* name_of_kind(RecordedKind kind);

}  // namespace sonarsim
