#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "gallery/boxes.h"

namespace sonarsim {

/// The number to five digits, for people.
nlohmann::ordered_json short_number(double value);

/// The measured values in the metadata of a sensor's pings: a column per number with a value per
/// ping, to five digits; null for a ping that lacks it or is not rendered. `sensor` is its block in
/// dataset.json.
nlohmann::ordered_json measured_columns(const std::filesystem::path& folder,
                                        const nlohmann::ordered_json& sensor);

/// The boxes of labels, per ping a list of [label, x, y, width, height], or 0 for none. Null where
/// the dataset has no boxes.
struct PingBoxes {
    nlohmann::ordered_json in_image;  ///< beams to the right, ranges down
    nlohmann::ordered_json in_fan;
};

/// The boxes of the label `objects` or, without it, of `yolo`, whose lines and boxes name classes
/// only.
PingBoxes ping_boxes(const std::filesystem::path& folder, const nlohmann::ordered_json& description,
                     const nlohmann::ordered_json& sensor, BoxLabels& labels);

}  // namespace sonarsim
