#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/dataset/json.h"

namespace sonarsim {

/// A sensor in dataset.json. Paths start at the folder of the dataset and lie in the sensor's own.
struct DescribedSensor {
    std::string name;
    std::uint32_t every = 1;  ///< pings at every n-th pose
    std::uint64_t pings = 0;
    std::vector<std::string> files;  ///< patterns of a file per ping: "fls/polar/%06d.npy"
    std::vector<std::string> records;
    std::vector<std::string> products;
};

struct DatasetFile {  // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    Json json;        ///< all of it
    bool complete = false;
    std::string mission;
    std::uint64_t poses = 0;
    std::vector<DescribedSensor> sensors;
    std::vector<std::string> products;  ///< products of all sensors together
};

/// The JSON of a file. InputError if unreadable, above 256 MiB, no JSON or nested above 64 deep.
Json read_json(const std::filesystem::path& path);

/// As it is, keys not checked; nothing if it is not sonarsim's. InputError if it cannot be read.
std::optional<Json> read_description(const std::filesystem::path& folder);

/// The one reader of dataset.json; `file` is for the messages. InputError for another version, a
/// key that is missing or of another type, or a path outside the folder of its sensor.
DatasetFile parse_description(Json json, const std::string& file);

/// The dataset.json of a folder that must hold a dataset: else InputError.
DatasetFile require_dataset(const std::filesystem::path& folder);

inline constexpr const char* another_mission = "of another mission";

/// The difference between two descriptions, keys not checked, as the end of a sentence about "a
/// dataset": "of another mission". Empty if both are the same dataset, complete or not.
std::string difference_between(const Json& found, const Json& expected);

/// "fls/polar/%06d.npy" with the number of a ping's pose in it.
std::string numbered(const std::string& pattern, std::uint64_t number);

/// The files that dataset.json lists, and the common ones, without SHA256SUMS.
std::vector<std::string> list_files(const DatasetFile& dataset);

/// True if SHA256SUMS in a folder is long enough to have a line for each file that dataset.json
/// lists, whose numbers may be any: it may come from anybody.
bool has_sums(const std::filesystem::path& folder, const DatasetFile& dataset);

/// The files that dataset.json of a folder lists. InputError unless has_sums().
std::vector<std::string> list_files(const std::filesystem::path& folder,
                                    const DatasetFile& dataset);

std::uint64_t count_pings(const DatasetFile& dataset);

/// True for a name of letters of ASCII, digits, '_', '-', '+' and '.', the first one not a '.'.
bool is_plain_name(std::string_view text);

}  // namespace sonarsim
