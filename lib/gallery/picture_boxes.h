#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "gallery/box_labels.h"

namespace sonarsim {

/// The boxes of labels in pictures of several pings, by the picture's path from the dataset's
/// folder: waterfalls and echograms (labels/coco_records.json) and scans (labels/coco_scans.json).
/// Each is a list of [label, x, y, width, height], px.
using PictureBoxes = std::map<std::string, nlohmann::ordered_json>;

/// Empty where the dataset has none.
PictureBoxes picture_boxes(const std::filesystem::path& folder,
                           const nlohmann::ordered_json& description, BoxLabels& labels);

}  // namespace sonarsim
