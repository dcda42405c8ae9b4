#include "recording/recorded_logs.h"

#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/file.h"
#include "core/units.h"
#include "format/sonar_log.h"
#include "recording/arrays.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_log_file = std::size_t{1} << 31;

SonarLog log_of_file(const std::filesystem::path& path, std::size_t most_pings,
                     std::optional<double> frequency_hz) {
    const std::string bytes = read_file(path, largest_log_file);
    try {
        return read_sonar_log(bytes, most_pings, frequency_hz);
    } catch (const std::runtime_error& fault) {
        throw InputError({path.string()}, fault.what());
    }
}

RecordedKind kind_of_log(LoggedKind kind) {
    if (kind == LoggedKind::scanning) return RecordedKind::scanning;
    return kind == LoggedKind::echosounder ? RecordedKind::echosounder : RecordedKind::imaging;
}

/// Sets or checks the law: the format defines it, or recording.yaml does.
void take_law(const SonarLog& log, const RecordingFile& file, Recording& recording) {
    if (log.decibels.has_value() == file.law.has_value())
        throw InputError(file.place.location,
                         file.law ? "the values of this format are decibels: leave `law` out"
                                  : "this format does not say what a value means: add `law`");
    if (!log.decibels) return;
    recording.law.kind = RecordedLaw::Kind::decibel;
    recording.law.range_db = log.decibels->range_db;
    recording.law.full_value = log.decibels->full_value;
}

/// Takes from the first file what holds for all.
void take_facts_of_log(const SonarLog& log, const RecordingFile& file, Recording& recording) {
    const RecordedKind kind = kind_of_log(log.kind);
    if (kind != file.kind)
        throw InputError(file.place.location, "'" + file.logs.front().string() +
                                                  "' has pings of the kind " + name_of_kind(kind));
    take_law(log, file, recording);
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

}  // namespace

void read_log_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording) {
    std::size_t values = 0;
    double step_s = 0.0;
    for (const std::filesystem::path& path : file.logs) {
        if (recording.pings.size() >= most_pings) break;
        SonarLog log = log_of_file(path, most_pings - recording.pings.size(), file.frequency_hz);
        if (recording.pings.empty()) {
            take_facts_of_log(log, file, recording);
            step_s = log.range_step_s;
        }
        if (std::fabs(log.range_step_s - step_s) > 1e-6 * step_s)
            throw InputError({path.string()}, "has another step of range than the first file");
        for (LoggedPing& own : log.pings) {
            values += own.values.size();
            if (values > most_recorded_values)
                throw InputError({path.string()},
                                 "makes more than 268,435,456 values in all; take fewer pings");
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

}  // namespace sonarsim
