#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/dataset_file.h"

namespace sonarsim {

/// The pictures of pings in tar archives, as the page shows them once they are unpacked: entries of
/// `pictures` for a sensor's block in dataset.json, by sensor. `member` is the folder of the
/// dataset, relative to that of the page.
std::map<std::string, nlohmann::ordered_json> pictures_in_packs(const std::string& member,
                                                                const DatasetFile& dataset);

/// Copies these pictures into gallery_folder_name of the folder of the page, since browsers open no
/// archives: the fans of each sensor, or its images if it has no fans. InputError when an archive
/// is damaged or the folder is a link; std::system_error when the disk fails.
void unpack_pictures(const std::filesystem::path& page, const std::string& member,
                     const DatasetFile& dataset);

}  // namespace sonarsim
