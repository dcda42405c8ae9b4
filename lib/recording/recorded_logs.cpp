#include "recording/recorded_logs.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/units.h"
#include "format/kmall_soundings.h"
#include "format/sonar_log.h"
#include "recording/file_of_pings.h"

namespace sonarsim {

namespace {

RecordedKind kind_of_log(LoggedKind kind) {
    if (kind == LoggedKind::scanning) return RecordedKind::scanning;
    return kind == LoggedKind::echosounder ? RecordedKind::echosounder : RecordedKind::imaging;
}

/// Sets or checks the law: the format defines it, or recording.yaml does.
void take_law(const std::optional<LoggedDecibels>& decibels, const RecordingFile& file,
              Recording& recording) {
    if (decibels.has_value() == file.law.has_value())
        throw InputError(file.place.location,
                         file.law ? "the values of this format are decibels: leave `law` out"
                                  : "this format does not say what a value means: add `law`");
    if (!decibels) return;
    recording.law.kind = RecordedLaw::Kind::decibel;
    recording.law.range_db = decibels->range_db;
    recording.law.full_value = decibels->full_value;
}

/// Takes the values that hold for all files from the first one.
void take_facts_of_log(const SonarLog& log, const RecordingFile& file, Recording& recording) {
    const RecordedKind kind = kind_of_log(log.kind);
    if (kind != file.kind)
        throw InputError(file.place.location, "'" + file.logs.front().string() +
                                                  "' has pings of the kind " + name_of_kind(kind));
    take_law(log.decibels, file, recording);
    if (file.sound_speed_m_s == 0.0) recording.sound_speed_m_s = log.sound_speed_m_s;
    if (!(recording.sound_speed_m_s > 0.0))
        throw InputError(file.place.location,
                         "this format does not have the speed of sound: add `sound_speed_m_s`");
    const double metres = 0.5 * recording.sound_speed_m_s;
    recording.range_step_m = metres * log.range_step_s;
    recording.first_range_m = metres * log.first_range_s;
    recording.bearing_rad = log.bearing_rad;
    const bool has_bearings =
        !file.bearings_deg.empty() || file.bearing_first_deg != file.bearing_last_deg;
    if (kind == RecordedKind::imaging && log.bearing_rad.empty() && !has_bearings)
        throw InputError(file.place.location,
                         "this format does not have the bearings of its beams: add "
                         "`bearing_first_deg` and `bearing_last_deg`, or `bearings_deg`");
    if (!recording.frequency_hz && log.frequency_hz > 0.0 && log.frequency_hz < 1e9)
        recording.frequency_hz = log.frequency_hz;
}

/// InputError if the file `path` has other ranges, beams or levels than the first of several files.
void require_alike(const SonarLog& log, const SonarLog& first, const std::filesystem::path& path) {
    const auto differ = [](double a, double b, double share) {
        return std::fabs(a - b) > share * std::fabs(b);
    };
    const auto refuse = [&](const char* what) {
        throw InputError({path.string()}, std::string("has ") + what + " than the first file");
    };
    if (log.kind != first.kind) refuse("another kind of sonar");
    if (differ(log.range_step_s, first.range_step_s, 1e-6)) refuse("another step of range");
    if (std::fabs(log.first_range_s - first.first_range_s) > 0.5 * first.range_step_s)
        refuse("another first range");
    // Sonars round it, and sweeps have a mean of their own. Chosen.
    if (differ(log.frequency_hz, first.frequency_hz, 0.01)) refuse("another frequency");
    if (log.bearing_rad.size() != first.bearing_rad.size()) refuse("another number of beams");
    if (log.decibels.has_value() != first.decibels.has_value() ||
        (log.decibels && (log.decibels->range_db != first.decibels->range_db ||
                          log.decibels->full_value != first.decibels->full_value)))
        refuse("another scale of levels");
}

}  // namespace

void read_log_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording) {
    std::size_t values = 0;
    std::optional<SonarLog> first;  // without its pings
    for (const std::filesystem::path& path : file.logs) {
        if (recording.pings.size() >= most_pings) break;
        SonarLog log = parsed_file(path, [&](const std::string& bytes) {
            return read_sonar_log(bytes, most_pings - recording.pings.size(), file.frequency_hz);
        });
        std::vector<LoggedPing> pings = std::exchange(log.pings, {});
        if (!first) {
            take_facts_of_log(log, file, recording);
            first = log;
        }
        require_alike(log, *first, path);
        for (LoggedPing& own : pings) {
            count_values(own.values.size(), path, values);
            RecordedPing& ping = recording.pings.emplace_back();
            ping.time_s = own.t_s;
            if (own.t_s == 0.0 && file.rate_hz > 0.0)
                ping.time_s = static_cast<double>(recording.pings.size() - 1) / file.rate_hz;
            ping.ranges = own.ranges;
            ping.beams = own.beams;
            ping.values = std::move(own.values);
            ping.bearing_rad = radians(file.head_first_deg) + own.bearing_rad;
        }
    }
}

void read_log_soundings(const RecordingFile& file, std::size_t most_pings, Recording& recording) {
    take_law(kmall_sounding_law, file, recording);
    std::size_t values = 0;
    for (const std::filesystem::path& path : file.logs) {
        if (recording.soundings.size() >= most_pings) break;
        const auto pings = parsed_file(path, [&](const std::string& bytes) {
            return read_kmall_soundings(bytes, most_pings - recording.soundings.size());
        });
        add_soundings(pings, path, file, values, recording);
    }
}

}  // namespace sonarsim
