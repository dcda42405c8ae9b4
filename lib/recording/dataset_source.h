#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dataset/checked_json.h"
#include "dataset/dataset_file.h"
#include "recording/arrays.h"

namespace sonarsim {

/// A sensor of a dataset that becomes a recording.
struct DatasetSource {
    std::filesystem::path folder;
    const DescribedSensor* sensor = nullptr;
    const nlohmann::ordered_json* json = nullptr;  ///< the sensor in dataset.json
    std::string file;                              ///< dataset.json, for messages
    std::size_t most_pings = 0;

    CheckedJson checked() const { return {*json, file}; }
    std::size_t pings() const { return std::min<std::size_t>(sensor->pings, most_pings); }
};

/// The pattern of a kind's files; nothing if there is none.
std::optional<std::string> pattern_of(const NamedTexts& patterns, const std::string& kind);

/// Visits the arrays of a kind: the number of the ping, the array and the file's
/// name. InputError for files that are missing or damaged.
void for_each_ping_array(
    const DatasetSource& source, const std::string& pattern,
    const std::function<void(std::size_t, const RecordedArray&, const std::string&)>& visit);

/// The middles of bins from their edges.
std::vector<double> middles(const CheckedJson& edges);

}  // namespace sonarsim
