#pragma once

#include <tiny_gltf.h>

#include <filesystem>

#include "scene/placed_file.h"

namespace sonarsim {

/// The most heights of a map: with two triangles each, a scene then takes about 12 GB.
inline constexpr std::size_t most_heights = std::size_t{1} << 25;

/// Reads an image of heights as tinygltf's structs, as if it were a glTF, with z up, of one node
/// "heightmap"; of a map larger than the rule's window only that part. A vertex stands at the
/// centre of each pixel; four neighbours make two triangles that share the edge from the first row
/// and column to the next of both. A triangle needs three known heights. Positions are (column,
/// row, value), and the node's matrix makes the coordinates of the map of them, so that maps far
/// from their origin lose nothing. InputError as read_image(), for an image of several channels,
/// one whose place is not known or in degrees, and for values that are no heights.
tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule);

}  // namespace sonarsim
