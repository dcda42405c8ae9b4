#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gallery/boxes.h"

namespace sonarsim {

/// The measured values in the metadata of a sensor's pings: a column per number with a value per
/// ping, to five digits; null for a ping that lacks it or is not rendered. `sensor` is its block in
/// dataset.json.
nlohmann::ordered_json measured_columns(const std::filesystem::path& folder,
                                        const nlohmann::ordered_json& sensor);

/// The boxes in a sort of pictures of a sensor's pings.
struct PictureBoxes {               // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    nlohmann::ordered_json pings;   ///< a list of boxes per ping, or 0 for none; null: no labels
    std::uint64_t mask_height = 0;  ///< height of the labelled picture, px; 0: without masks
};

struct PingBoxes {          // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    PictureBoxes in_image;  ///< beams to the right, ranges down
    PictureBoxes in_fan;
};

/// The boxes of COCO files; without them those of the label `objects`; without that those of
/// `yolo`, whose lines name classes only.
PingBoxes ping_boxes(const std::filesystem::path& folder, const nlohmann::ordered_json& sensor,
                     const CocoBoxes& coco, const BoxLabels& labels);

}  // namespace sonarsim
