#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

// Counts of the annotations in its COCO files.

namespace sonarsim {

/// A value of annotations whose histogram is kept. An annotation may lack it.
struct StatisticsAxis {
    const char* key;    ///< in the annotation and in the file: "range_m"
    const char* title;  ///< for people: "range, m"
    /// Count 0 is for values below edge 0, count k for values from edge k - 1 on and below edge k,
    /// and the last count for values from the last edge on.
    std::span<const double> edges;
};
inline constexpr std::size_t statistics_axes = 4;
const std::array<StatisticsAxis, statistics_axes>& all_statistics_axes();

/// The annotations of a class. Annotations that a network must ignore (`iscrowd`) count only as
/// ignored.
struct ClassTally {
    std::string name;
    std::uint64_t objects = 0;   ///< number of different objects in the pictures
    std::uint64_t pictures = 0;  ///< number of pictures with an object of the class
    std::uint64_t annotations = 0;
    std::uint64_t ignored = 0;
    std::array<std::vector<std::uint64_t>, statistics_axes> histograms;
};

struct PictureTally {
    std::uint64_t pictures = 0;
    std::uint64_t without_objects = 0;
    std::vector<ClassTally> classes;  ///< every class of the COCO files, in their order
};

struct DatasetStatistics {
    /// Every picture once: fans that show the pings of polar images do not count.
    PictureTally all;
    std::vector<std::pair<std::string, PictureTally>> files;  ///< each COCO file has its own
};

/// A tally as it stands in the file.
nlohmann::ordered_json tally_json(const PictureTally& tally);

/// Counts the annotations of the COCO files ("labels/coco.json") in a folder, and writes
/// statistics.json. If `joined`, a picture's path begins with the folder of its dataset, and equal
/// ids in different folders are different objects. The same COCO files give the same bytes.
/// InputError, with the line, when a COCO file is damaged.
void write_statistics(const std::filesystem::path& folder, std::span<const std::string> coco_files,
                      bool joined);

/// The statistics.json of a folder; nothing if it has none. InputError, with the key and what it
/// must be, when it is damaged.
std::optional<DatasetStatistics> read_statistics(const std::filesystem::path& folder);

}  // namespace sonarsim
