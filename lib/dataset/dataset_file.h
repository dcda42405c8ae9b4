#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sonarsim {

/// Texts by name, in the order of the file.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// A sensor as dataset.json describes it. Every path is relative to the folder of the dataset and
/// lies in the folder of the sensor.
struct DescribedSensor {
    std::string name;
    std::uint64_t every = 1;  ///< pings at every n-th pose
    std::uint64_t pings = 0;
    double full_scale = 0.0;
    NamedTexts files;  ///< patterns by kind: "polar", ...
    std::optional<std::string> records;
    NamedTexts label_records;  ///< files by label
    std::vector<std::string> products;
    std::uint64_t range_bins = 0;
    std::uint64_t azimuth_bins = 0;  ///< 0 where the kind has none
};

/// A dataset.json whose keys were checked.
struct DatasetFile {              // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    nlohmann::ordered_json json;  ///< all of it
    bool complete = false;
    std::string mission;  ///< fit for the name of a folder
    std::string mission_hash;
    std::string inputs_hash;
    std::uint64_t seed = 0;
    std::uint64_t poses = 0;
    std::vector<DescribedSensor> sensors;
    std::vector<std::string> products;  ///< products of all sensors together
};

/// The dataset.json of a folder, its keys not checked; nothing if it is not sonarsim's.
/// InputError when it cannot be read.
std::optional<nlohmann::ordered_json> read_description(const std::filesystem::path& folder);

/// The one reader of dataset.json. `file` is for the messages. InputError, with the key and what it
/// must be, when it is of another version of the format, when a key is missing or of
/// another type, when a number is out of range, when a name is not plain (see dataset/file_names.h)
/// and when a path leaves the folder of its sensor.
DatasetFile check_description(nlohmann::ordered_json json, const std::string& file);

/// The dataset.json of a folder that must hold a dataset: else InputError.
DatasetFile require_dataset(const std::filesystem::path& folder);

}  // namespace sonarsim
