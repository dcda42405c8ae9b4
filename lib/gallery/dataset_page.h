#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/dataset_file.h"

namespace sonarsim {

/// The part of the page that shows a dataset: its poses, sensors, pictures, measurements and
/// labels. `member` is the folder of the dataset, relative to that of the page, for its unpacked
/// pictures. `classes` are the classes of the page by their numbers; those of this dataset are
/// added. InputError when a file of the dataset is damaged or does not fit the others.
nlohmann::ordered_json dataset_json(const std::filesystem::path& page, const std::string& member,
                                    const DatasetFile& dataset, std::vector<std::string>& classes);

}  // namespace sonarsim
