#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/dataset_file.h"

namespace sonarsim {

/// The part of the page that shows a dataset: its poses, sensors, pictures, measurements and
/// labels. `member` is its
/// folder, relative to that of the page, in which it looks for unpacked pictures. `classes`
/// are the classes of the page by their numbers, to which those of this dataset are added.
/// InputError when a file of the dataset is damaged or does not fit the others.
nlohmann::ordered_json dataset_json(const std::filesystem::path& page, const std::string& member,
                                    const DatasetFile& dataset, std::vector<std::string>& classes);

}  // namespace sonarsim
