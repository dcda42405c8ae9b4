#include "recording/recorded_arrays.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/units.h"
#include "recording/arrays.h"
#include "recording/check_recording.h"
#include "recording/recorded_logs.h"
#include "recording/recorded_oculus.h"
#include "recording/recorded_xtf.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_sides = std::size_t{1} << 20;

/// The lengths of an array as three: pings, rows and columns of each.
struct PingShape {
    std::size_t pings = 0, rows = 0, columns = 0;
};

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape)
        text += (text.empty() ? "[" : ", ") + std::to_string(length);
    return text + "]";
}

/// Images have [range, beam] or [ping, range, beam]; others [ping, range].
PingShape shape_of_pings(const RecordedArray& array, RecordedKind kind, const std::string& name) {
    const std::vector<std::size_t>& s = array.shape;
    const bool is_image = kind == RecordedKind::imaging;
    PingShape shape;
    if (is_image && s.size() == 3) shape = {s[0], s[1], s[2]};
    if (is_image && s.size() == 2) shape = {1, s[0], s[1]};
    if (!is_image && s.size() == 2) shape = {s[0], s[1], 1};
    if (shape.pings == 0 || std::max(shape.rows, shape.columns) > most_sides) {
        throw InputError({name},
                         "has the shape " + shape_text(s) + "; the kind " + name_of_kind(kind) +
                             " needs " +
                             (is_image ? "[range, beam] or [ping, range, beam]" : "[ping, range]") +
                             " with at most 1,048,576 ranges");
    }
    return shape;
}

/// A row of a side-scan: port from the largest range to nadir, then starboard from nadir on.
RecordedPing two_sides(const double* row, std::size_t columns) {
    const std::size_t ranges = columns / 2;
    RecordedPing ping;
    ping.ranges = static_cast<int>(ranges);
    ping.beams = 2;
    ping.values.resize(2 * ranges);
    for (std::size_t i = 0; i < ranges; ++i) {
        ping.values[2 * i] = static_cast<float>(row[ranges - 1 - i]);
        ping.values[2 * i + 1] = static_cast<float>(row[ranges + i]);
    }
    return ping;
}

RecordedPing ping_of(const RecordedArray& array, const PingShape& shape, RecordedKind kind,
                     std::size_t k) {
    const std::size_t count = shape.rows * shape.columns;
    const double* first = array.values.data() + k * count;
    if (kind == RecordedKind::sidescan) return two_sides(first, shape.rows);
    RecordedPing ping;
    ping.ranges = static_cast<int>(shape.rows);
    ping.beams = static_cast<int>(shape.columns);
    ping.values.assign(first, first + count);
    return ping;
}

void add_pings(const RecordedArray& array, const std::string& name, std::size_t most_pings,
               std::size_t& values, Recording& recording) {
    const PingShape shape = shape_of_pings(array, recording.kind, name);
    if (recording.kind == RecordedKind::sidescan && (shape.rows < 2 || shape.rows % 2 != 0))
        throw InputError({name}, "has " + std::to_string(shape.rows) +
                                     " columns; a side-scan has as many of port as of starboard");
    for (std::size_t k = 0; k < shape.pings; ++k) {
        if (recording.pings.size() == most_pings) return;
        values += shape.rows * shape.columns;
        if (values > most_recorded_values)
            throw InputError({name}, "makes more than 268,435,456 values in all; take fewer pings");
        recording.pings.push_back(ping_of(array, shape, recording.kind, k));
    }
}

void read_soundings(const SoundingFiles& files, std::size_t most_pings, Recording& recording) {
    const RecordedArray range = read_array_file(files.range_m);
    const RecordedArray angle = read_array_file(files.angle_rad);
    const RecordedArray intensity = read_array_file(files.intensity);
    if (range.shape.size() != 2)
        throw InputError({files.range_m.string()},
                         "has the shape " + shape_text(range.shape) + ", not [ping, beam]");
    for (const auto& [array, path] :
         {std::pair(&angle, &files.angle_rad), std::pair(&intensity, &files.intensity)}) {
        if (array->shape != range.shape)
            throw InputError({path->string()}, "has the shape " + shape_text(array->shape) +
                                                   ", and the ranges have " +
                                                   shape_text(range.shape));
    }
    const std::size_t beams = range.shape[1];
    for (std::size_t k = 0; k < std::min(range.shape[0], most_pings); ++k) {
        RecordedSoundings& ping = recording.soundings.emplace_back();
        for (std::size_t i = k * beams; i < (k + 1) * beams; ++i) {
            const double values[] = {range.values[i], angle.values[i], intensity.values[i]};
            if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) continue;
            ping.range_m.push_back(static_cast<float>(values[0]));
            ping.angle_rad.push_back(static_cast<float>(values[1]));
            ping.intensity.push_back(static_cast<float>(values[2]));
        }
    }
}

std::vector<double> bearings_of(const RecordingFile& file, std::size_t beams) {
    constexpr double degree = pi / 180.0;
    std::vector<double> bearings;
    for (const double bearing : file.bearings_deg)
        bearings.push_back(bearing * degree);
    if (!bearings.empty()) return bearings;
    const double first = file.bearing_first_deg * degree;
    const double last = file.bearing_last_deg * degree;
    for (std::size_t k = 0; k < beams; ++k) {
        const double share =
            beams > 1 ? static_cast<double>(k) / static_cast<double>(beams - 1) : 0.5;
        const double sine = sincos(first).sin + share * (sincos(last).sin - sincos(first).sin);
        bearings.push_back(file.spread == BearingSpread::sine ? arcsin(std::clamp(sine, -1.0, 1.0))
                                                              : first + share * (last - first));
    }
    return bearings;
}

void set_times(const RecordingFile& file, Recording& recording) {
    const std::size_t count = std::max(recording.pings.size(), recording.soundings.size());
    if (!file.times_s.empty() && file.times_s.size() < count)
        throw InputError(file.place.location, "times_s has " + std::to_string(file.times_s.size()) +
                                                  " times for " + std::to_string(count) + " pings");
    if (file.times_s.empty() && file.rate_hz == 0.0 && count > 1)
        throw InputError(
            file.place.location,
            "'recording' lacks the key 'rate_hz' or 'times_s': there are several pings");
    for (std::size_t k = 0; k < count; ++k) {
        const double from_rate = file.rate_hz > 0.0 ? static_cast<double>(k) / file.rate_hz : 0.0;
        const double time = file.times_s.empty() ? from_rate : file.times_s[k];
        if (k < recording.soundings.size()) recording.soundings[k].time_s = time;
        if (k >= recording.pings.size()) continue;
        recording.pings[k].time_s = time;
        recording.pings[k].bearing_rad =
            (file.head_first_deg + static_cast<double>(k) * file.head_step_deg) * pi / 180.0;
    }
}

}  // namespace

Recording read_recorded_arrays(const RecordingFile& file, std::size_t most_pings) {
    if (most_pings == 0) most_pings = most_sides;
    Recording recording;
    recording.kind = file.kind;
    if (file.law) recording.law = *file.law;
    recording.sound_speed_m_s = file.sound_speed_m_s;
    recording.first_range_m = file.first_range_m;
    recording.range_step_m = file.range_step_m;
    recording.frequency_hz = file.frequency_hz;
    recording.altitude_m = file.altitude_m;
    if (file.pitch_deg) recording.pitch_rad = *file.pitch_deg * pi / 180.0;
    std::size_t values = 0;
    for (const std::filesystem::path& path : file.files) {
        if (recording.pings.size() == most_pings) break;
        add_pings(read_array_file(path), path.string(), most_pings, values, recording);
    }
    if (!file.xtf.empty()) {
        if (file.kind == RecordedKind::soundings)
            read_xtf_pings_of_soundings(file, most_pings, recording);
        else
            read_xtf_pings(file, most_pings, recording);
        check_recording(recording, file.place.location.file);
        return recording;
    }
    if (!file.logs.empty()) {
        if (file.kind == RecordedKind::soundings)
            read_log_soundings(file, most_pings, recording);
        else
            read_log_pings(file, most_pings, recording);
        if (recording.kind == RecordedKind::imaging && recording.bearing_rad.empty())
            recording.bearing_rad =
                bearings_of(file, static_cast<std::size_t>(recording.pings.front().beams));
        check_recording(recording, file.place.location.file);
        return recording;
    }
    if (!file.oculus.empty()) {
        read_oculus_pings(file, most_pings, recording);
        set_times(file, recording);
        check_recording(recording, file.place.location.file);
        return recording;
    }
    if (file.soundings) read_soundings(*file.soundings, most_pings, recording);
    if (recording.kind == RecordedKind::imaging && !recording.pings.empty())
        recording.bearing_rad =
            bearings_of(file, static_cast<std::size_t>(recording.pings.front().beams));
    set_times(file, recording);
    check_recording(recording, file.place.location.file);
    return recording;
}

}  // namespace sonarsim
