#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "gallery/boxes.h"
#include "gallery/ping_tables.h"

namespace sonarsim {

/// The pictures of a sensor, which its block in dataset.json lists, as the scripts of the page take
/// them: a list of
///
///     title, file    a path, with %06d for a number where there are several
///     unpacked       true: of the archives: the path begins at the folder of the page
///     per            "ping": a picture of each; "sweep": of each `pings`; absent: one of all
///     turned         row 0 is the nearest range and column 0 starboard: shown upside down, so that
///                    port is on the left and ahead is up as in a fan
///     boxes          see PictureBoxes; of a sweep a list of each, of a picture of all pings one
///     list mask_height    height of the picture that the masks of the boxes cover, px pixel of a
///     picture of all pings: size of a pixel of that picture, x and y, px along, origin, step of a
///     picture of all pings: the axis along which they lie, and where
///                    the first begins and how long one is, x and y, px
///     radius         of a scan: its greatest range as a share of the width
///
/// InputError when the dataset was written before dataset.json listed pictures.
nlohmann::ordered_json views_of(const std::filesystem::path& folder,
                                const nlohmann::ordered_json& sensor, const CocoBoxes& coco,
                                const BoxLabels& labels);

/// A sentence about data of a sensor that the page cannot show; empty if it shows everything.
std::string note_about(const nlohmann::ordered_json& sensor, const nlohmann::ordered_json& views);

}  // namespace sonarsim
