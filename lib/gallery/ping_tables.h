#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "gallery/box_labels.h"

namespace sonarsim {

/// To five digits: it is to be looked at.
nlohmann::ordered_json short_number(double value);

/// What the metadata of a sensor's pings say was measured, each number in a column of one value per
/// ping, to five digits; null where a ping lacks it or is not rendered. `sensor` is its block in
/// dataset.json.
nlohmann::ordered_json measured_columns(const std::filesystem::path& folder,
                                        const nlohmann::ordered_json& sensor);

/// The boxes of labels, per ping a list of [label, x, y, width, height], or 0 for none. Null where
/// the dataset has no boxes.
struct PingBoxes {
    nlohmann::ordered_json in_image;  ///< beams to the right, ranges down
    nlohmann::ordered_json in_fan;
};

/// Those of the label `objects`, or of `yolo` where that is what there is: its lines tell classes
/// alone, and so do the boxes.
PingBoxes ping_boxes(const std::filesystem::path& folder, const nlohmann::ordered_json& description,
                     const nlohmann::ordered_json& sensor, BoxLabels& labels);

}  // namespace sonarsim
