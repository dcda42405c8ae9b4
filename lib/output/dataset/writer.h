#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "input/mission/mission.h"
#include "output/dataset/json.h"
#include "output/dataset/labelled_ping.h"
#include "output/dataset/record_file.h"
#include "output/format/npy.h"
#include "output/format/png.h"
#include "simulate/assembly/assemble.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

/// The sensor that a writer writes for.
struct WriterContext {
    const Mission& mission;
    const Assembly& assembly;
    std::size_t sensor;  ///< index in Mission::sensors
    std::size_t pings;   ///< number of its pings in the whole mission

    const Sonar& sonar() const { return assembly.sonars[sensor]; }
    const KindOfSonar& kind() const { return kind_of(sonar().config.kind); }
    double full_scale() const { return assembly.full_scales[sensor]; }
};

/// A finished ping with everything that a writer may need.
struct FinishedPing {
    PingId id;
    const Sonar& sonar;  ///< as it was for this ping
    const TracedPing& traced;
    const Ping& ping;
    const Json& measured;                  ///< for the metadata of the ping; null for none
    std::uint64_t clipped_pixels;          ///< intensities above full_scale
    const LabelledPing* labels = nullptr;  ///< null if output.labels asks for none
};

/// The drawn values by key; text if a value is neither a number nor a flag.
Json describe_drawn(const DrawnValues& drawn);

/// Adds the number of the mission's variant and what was drawn for it, if it is one.
void describe_variant(const Mission& mission, Json& json);

/// The metadata of one ping.
Json describe_ping(const Mission& mission, const Assembly& assembly, const FinishedPing& finished);

/// The meaning of the rows and columns of a file of a ping.
enum class PingArray {
    none,  ///< no rows and columns, or of another meaning
    bins,  ///< [range, azimuth], the bins of the ping
    fan,   ///< [row, column], the pixels of the fan
};

/// A file per ping: NAME/000000EXTENSION in the folder of the sensor.
struct PingFile {
    std::string name;       ///< name of the folder
    std::string extension;  ///< with the dot
    PingArray array = PingArray::none;
    std::string ids = {};    ///< list of `labels` in dataset.json whose ids the values are
    std::string title = {};  ///< title of a picture for people; "": no picture
};

/// A record per ping, in one file for all pings of the sensor.
struct PingRecord {  // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    std::string file;
    NpyFormat format;
    Json axes;               ///< the meaning of the indices, for dataset.json
    std::string label = {};  ///< kind of the values: a label, "raw", or "" for the echoes
    std::string ids = {};    ///< as in PingFile
};

// Labels of records that only objects need: the shadow of objects that are not background, the
// visible share of a bin's object (65535: all), and, without `mask: echo`, its silhouette.
inline constexpr const char* object_shadow_record = "object_shadow";
inline constexpr const char* visible_share_record = "visible_share";
inline constexpr const char* silhouette_record = "silhouette";
/// The objects in the picture of all pings of a sensor.
inline constexpr const char* record_objects_name = "objects.json";

/// The output of a writer for a ping, known before the first one.
using PingOutput = std::variant<PingFile, PingRecord>;

/// A record in the shape of the sonar's kind, in STEM.npy. `type` is the NumPy type of the numbers.
PingRecord record_of_kind(const WriterContext& context, const std::string& stem, const char* type,
                          std::string label = {}, std::string ids = {});

/// STEM_NNNN with each extension, for every sweep of a scanning sonar.
std::vector<std::string> sweep_files(const WriterContext& context, const std::string& stem,
                                     const std::vector<std::string>& extensions);

/// The numbers in a ping's file or record.
struct PingNumbers {
    std::variant<std::vector<float>, std::vector<std::uint16_t>, std::vector<std::uint8_t>> values;
    std::vector<std::size_t> shape;  ///< [rows, columns], or [values] of a record
};

/// An image [range bins, beams] as rows and columns, or as the record; `blank` is for no bin.
template <class T>
PingNumbers numbers_of(const Sonar& sonar, std::vector<T> image, T blank) {
    const KindOfSonar& kind = kind_of(sonar.config.kind);
    if (!kind.has_images)
        return {record_values(kind.record, sonar.config, image, blank),
                {kind.record.values(sonar.config)}};
    const auto beams = static_cast<std::size_t>(sonar.settings.view.beams);
    const std::size_t rows = image.size() / beams;
    return {std::move(image), {rows, beams}};
}
/// The numbers as the bytes of a record.
inline std::string record_bytes(const PingNumbers& numbers) {
    return std::visit([](const auto& values) { return record_bytes(values); }, numbers.values);
}

/// One output format of one sensor, for any number of threads; the context must outlive it. A
/// resumed run finds finished pings by the journal, and makes products unless all exist.
struct Writer {
    PingOutput per_ping;
    /// Files that are made of the records of all pings.
    std::vector<std::string> products = {};
    /// The bytes of the ping's file, or of its record.
    std::function<std::string(const FinishedPing&)> encode;
    /// The numbers that a reader of those bytes gets; null for text or a picture for people.
    std::function<PingNumbers(const FinishedPing&)> numbers = {};
    /// Makes the products in a folder, in memory that does not grow with the number of pings.
    std::function<void(const RecordFile&, const std::filesystem::path&)> write_products = {};
    /// Adds to the sensor's block in dataset.json.
    std::function<void(Json& sensor)> describe = {};
};

/// A writer of numbers: records, or files in .npy or PNG.
Writer array_writer(PingOutput per_ping, std::function<PingNumbers(const FinishedPing&)> numbers,
                    PngFilter filter = PngFilter::none);

/// The writers of one sensor, in the order in which a ping is written.
using Writers = std::vector<Writer>;

/// The writers of each sensor. InputError for the label `fan` without a fan.
std::vector<Writers> make_writers(const Mission& mission, const Assembly& assembly);

/// The writers of one of them.
Writers make_writers(const WriterContext& context);

/// The writers of a sensor's raw values and labels alone; empty if the mission asks for neither.
Writers make_array_writers(const WriterContext& context);

/// The number of pings of a sensor on a trajectory of `poses` poses.
inline std::size_t count_pings(const SonarConfig& sensor, std::size_t poses) {
    const auto every = static_cast<std::size_t>(sensor.every);
    return (poses + every - 1) / every;
}

}  // namespace sonarsim
