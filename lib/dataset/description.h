#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/dataset_file.h"

namespace sonarsim {

inline constexpr const char* of_another_mission = "of another mission";

/// The difference between two descriptions as the end of a sentence that begins with "a dataset":
/// "of another mission". Empty if both are the same dataset, complete or not. Their keys need not
/// be checked.
std::string difference_between(const nlohmann::ordered_json& found,
                               const nlohmann::ordered_json& expected);

/// The properties of a dataset's build that its bytes depend on, as text. Keys need not be checked.
std::string bytes_of_build(const nlohmann::ordered_json& description);

/// A file of a dataset.
struct DescribedFile {
    std::string name;                         ///< relative to the folder of the dataset
    const DescribedSensor* sensor = nullptr;  ///< null for files that belong to no sensor
    std::string kind;                         ///< "polar", ..., "packs", "records", or empty
};

/// Visits each file that dataset.json lists, SHA256SUMS included, until `visit` returns
/// false.
void for_each_described(const DatasetFile& dataset,
                        const std::function<bool(const DescribedFile&)>& visit);

}  // namespace sonarsim
