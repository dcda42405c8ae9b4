#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/scene/seabed/seabed.h"

namespace sonarsim {

// The true heights, materials and objects of a generated sea bed: the files in OUT/seabed/.

/// World z of the cells: a GeoTIFF in the mission's x and y, which scene.heightmap reads.
inline constexpr const char* seabed_heights_name = "seabed/heights.tif";
/// The material of each cell, a grey PNG of 8 bits with the index of the material, and its world
/// file.
inline constexpr const char* seabed_materials_name = "seabed/materials.png";
inline constexpr const char* seabed_place_name = "seabed/materials.pgw";
/// The place of these maps, the materials, and all rocks.
inline constexpr const char* seabed_list_name = "seabed/seabed.json";

/// The names of these files, relative to the folder of a dataset.
std::vector<std::string> seabed_file_names();

/// Their bytes, by name.
std::vector<std::pair<std::string, std::string>> seabed_files(const Seabed& bed);

}  // namespace sonarsim
