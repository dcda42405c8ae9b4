#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "gallery/boxes.h"
#include "gallery/ping_tables.h"

namespace sonarsim {

/// The pictures of a sensor, which its block in dataset.json lists, as the scripts of the page take
/// them: a list of
///
///     title, file    a path, with %06d for a number if there are several
///     unpacked       true for pictures from archives: the path begins at the folder of the page
///     per            "ping": a picture of each ping; "sweep": of each `pings` pings; absent: one
///                    picture of all pings
///     turned         row 0 is the nearest range and column 0 starboard: shown upside down, so that
///                    port is on the left and ahead is up as in a fan
///     boxes          see PictureBoxes; for sweeps a list for each, for a picture of all pings one
///                    list
///     mask_height    height of the picture that the masks of the boxes cover, px
///     pixel          for a picture of all pings: size in it of a pixel of the picture that the
///                    masks cover, x and y, px
///     along, origin, step   for a picture of all pings: the axis along which the pings lie, where
///                    the first begins and how long one is, x and y, px
///     radius         for sweeps: the greatest range as a share of the width
///
/// InputError when the dataset was written before dataset.json listed pictures.
nlohmann::ordered_json views_of(const std::filesystem::path& folder,
                                const nlohmann::ordered_json& sensor, const CocoBoxes& coco,
                                const BoxLabels& labels);

/// A sentence about data of a sensor that the page cannot show; empty if it shows everything.
std::string note_about(const nlohmann::ordered_json& sensor, const nlohmann::ordered_json& views);

}  // namespace sonarsim
