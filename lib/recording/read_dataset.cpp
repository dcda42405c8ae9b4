#include "recording/read_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/checked_json.h"
#include "dataset/dataset_file.h"
#include "dataset/file_names.h"
#include "mission/dataset_names.h"
#include "mission/document.h"
#include "mission/node_values.h"
#include "recording/arrays.h"
#include "recording/check_recording.h"
#include "recording/dataset_soundings.h"
#include "recording/dataset_source.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_resolved_yaml = std::size_t{1} << 26;
constexpr std::size_t most_dataset_pings = std::size_t{1} << 20;

const DescribedSensor& sensor_named(const DatasetFile& dataset, const std::string& name,
                                    const fs::path& folder) {
    std::vector<std::string> names;
    for (const DescribedSensor& sensor : dataset.sensors) {
        if (sensor.name == name || (name.empty() && dataset.sensors.size() == 1)) return sensor;
        names.push_back(sensor.name);
    }
    if (name.empty())
        throw InputError({folder.string()},
                         "has several sensors; choose one with --sensor: " + listed(names));
    throw InputError({folder.string()}, "has no sensor '" + printable(name) + "'" +
                                            did_you_mean(name, names) +
                                            "; there are: " + listed(names));
}

void require_shape(const RecordedArray& array, const std::vector<std::size_t>& shape,
                   const std::string& name) {
    if (array.shape != shape)
        throw InputError({name},
                         "has another shape than dataset.json says; sonarsim verify says more");
}

void read_images(const DatasetSource& source, const std::string& pattern, Recording& recording) {
    const DescribedSensor& sensor = *source.sensor;
    std::size_t values = 0;
    recording.pings.resize(source.pings());
    for_each_ping_array(
        source, pattern, [&](std::size_t k, const RecordedArray& array, const std::string& name) {
            require_shape(array, {sensor.range_bins, sensor.azimuth_bins}, name);
            values += array.values.size();
            if (values > most_recorded_values)
                throw InputError(
                    {name},
                    "makes more than 268,435,456 values in all; take fewer pings with --pings");
            RecordedPing& ping = recording.pings[k];
            ping.ranges = static_cast<int>(sensor.range_bins);
            ping.beams = static_cast<int>(sensor.azimuth_bins);
            ping.values.assign(array.values.begin(), array.values.end());
        });
}

/// Records [ping, range] or [range, ping]; of a side-scan port from the largest range to nadir,
/// then starboard.
void read_records(const DatasetSource& source, const std::string& file, Recording& recording) {
    const fs::path path = source.folder / file;
    const RecordedArray array = read_array_file(path);
    const bool is_sidescan = recording.kind == RecordedKind::sidescan;
    const bool is_upright = recording.kind == RecordedKind::echosounder;
    const std::size_t ranges = source.sensor->range_bins;
    const std::size_t pings = source.sensor->pings;
    if (array.shape.size() != 2) require_shape(array, {pings, ranges}, path.string());
    const std::size_t row = array.shape[is_upright ? 0 : 1];
    const std::size_t beams = is_sidescan ? 2 : 1;
    const std::size_t side = row / beams;
    if (array.shape[is_upright ? 1 : 0] != pings || side < ranges || row % beams != 0)
        require_shape(array, {pings, ranges}, path.string());
    for (std::size_t k = 0; k < source.pings(); ++k) {
        RecordedPing& ping = recording.pings.emplace_back();
        ping.ranges = static_cast<int>(side);
        ping.beams = static_cast<int>(beams);
        for (std::size_t i = 0; i < side; ++i) {
            if (is_upright) {
                ping.values.push_back(static_cast<float>(array.values[i * pings + k]));
            } else if (is_sidescan) {
                ping.values.push_back(static_cast<float>(array.values[k * row + side - 1 - i]));
                ping.values.push_back(static_cast<float>(array.values[k * row + side + i]));
            } else {
                ping.values.push_back(static_cast<float>(array.values[k * row + i]));
            }
        }
    }
}

const YamlNode* find_node(const YamlNode* node, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        if (node != nullptr) node = node->find(key);
    }
    return node;
}

/// The law of raw/, which the keys of the receiver in mission.resolved.yaml set.
RecordedLaw law_of_raw(const YamlNode* receiver, const std::string& file) {
    if (receiver == nullptr) throw InputError({file}, "lacks the receiver of the sensor");
    const auto number = [&](const char* key, double fallback, const Limits& limits) {
        const YamlNode* node = receiver->find(key);
        return node == nullptr ? fallback : read_number(*node, key, limits);
    };
    RecordedLaw law;
    const YamlNode* companding = receiver->find("companding");
    const std::string name = companding == nullptr ? "gamma" : companding->text;
    law.kind = name == "gamma" ? RecordedLaw::Kind::gamma
               : name == "log" ? RecordedLaw::Kind::decibel
                               : RecordedLaw::Kind::amplitude;
    law.exponent = number("gamma", 0.5, between(0.1, 2));
    law.range_db = number("dynamic_range_db", 60, between(10, 200));
    law.full_value =
        static_cast<double>((1U << static_cast<unsigned>(number("bits", 8, between(4, 16)))) - 1);
    law.offset = number("offset", 0, between(0, 0.9));
    return law;
}

void set_facts(const DatasetSource& source, bool is_raw, Recording& recording) {
    const fs::path file = source.folder / mission_name;
    const YamlNode mission = read_document(read_file(file, largest_resolved_yaml), file.string());
    const YamlNode* own = find_node(&mission, {"sensors", source.sensor->name});
    const bool is_calibrated = source.json->contains("instrument");
    recording.law.kind = is_calibrated ? RecordedLaw::Kind::power : RecordedLaw::Kind::amplitude;
    recording.law.full_value = is_calibrated ? 1.0 : source.sensor->full_scale;
    if (is_raw)
        recording.law = law_of_raw(find_node(own, {"instrument", "receiver"}), file.string());
    if (const YamlNode* speed = find_node(&mission, {"water", "sound_speed_m_s"});
        speed && parse_number(speed->text))
        recording.sound_speed_m_s = read_number(*speed, "sound_speed_m_s", above(0));
    if (const YamlNode* frequency = find_node(own, {"instrument", "frequency_hz"});
        frequency && is_calibrated)
        recording.frequency_hz = read_number(*frequency, "frequency_hz", above(0));
}

RecordedKind kind_of_sensor(const DatasetSource& source) {
    const std::string kind = source.checked().at("kind").text();
    if (kind == "sidescan") return RecordedKind::sidescan;
    if (kind == "echosounder") return RecordedKind::echosounder;
    if (kind == "scanning") return RecordedKind::scanning;
    if (kind == "profiling") return RecordedKind::soundings;
    return RecordedKind::imaging;
}

}  // namespace

Recording read_dataset_recording(const fs::path& folder, const RecordingOptions& options) {
    const DatasetFile dataset = require_dataset(folder);
    DatasetSource source{.folder = folder, .file = (folder / description_name).string()};
    source.sensor = &sensor_named(dataset, options.sensor, folder);
    const auto index = static_cast<std::size_t>(source.sensor - dataset.sensors.data());
    source.json = &dataset.json.at("sensors").at(index);
    source.most_pings = options.most_pings == 0 ? most_dataset_pings : options.most_pings;
    if (!dataset.complete)
        throw InputError({folder.string()}, "is not complete; run the render command again");

    Recording recording;
    recording.kind = kind_of_sensor(source);
    const std::vector<double> ranges = middles(source.checked().at("range_edges_m"));
    recording.first_range_m = ranges.front();
    recording.range_step_m = ranges.size() > 1 ? ranges[1] - ranges[0] : 0.0;
    const NamedTexts& patterns = source.sensor->files;
    const auto raw_records = pattern_of(source.sensor->label_records, "raw");
    const auto raw = pattern_of(patterns, "raw");
    set_facts(source, raw || raw_records, recording);
    const bool is_imaging = recording.kind == RecordedKind::imaging;
    const bool is_soundings = recording.kind == RecordedKind::soundings;
    if (!is_imaging && !source.sensor->records)
        throw InputError({folder.string()}, "has no file of records of this sensor");
    if (is_imaging || is_soundings) {
        const auto polar = raw ? raw : pattern_of(patterns, "polar");
        if (!polar)
            throw InputError({folder.string()},
                             "has neither raw/ nor polar/ of this sensor; set output.polar: true");
        if (is_soundings) {
            read_dataset_soundings(source, *polar, recording);
        } else {
            recording.bearing_rad = middles(source.checked().at("azimuth_edges_rad"));
            read_images(source, *polar, recording);
        }
    } else {
        read_records(source, raw_records ? *raw_records : *source.sensor->records, recording);
    }
    // The time of a ping is in its metadata, but figures need only the order.
    for (std::size_t k = 0; k < recording.pings.size(); ++k)
        recording.pings[k].time_s = static_cast<double>(k);
    check_recording(recording, folder.string());
    return recording;
}

}  // namespace sonarsim
