#pragma once

#include <tiny_gltf.h>

#include <filesystem>

#include "scene/placed_file.h"

namespace sonarsim {

class ImageReader;

/// Reads an image of heights as tinygltf's structs, as if it were a glTF, with z up, of one node
/// "heightmap"; of a map larger than the rule's window only that part. A vertex stands at the
/// centre of each pixel; four neighbours make two triangles that share the edge from the first row
/// and column to the next of both. A triangle needs three known heights. Positions are (column,
/// row, value), and the node's matrix makes the coordinates of the map of them, so that maps far
/// from their origin lose nothing. Every n-th row and column is kept, n = rule.every, and the last
/// ones. InputError as read_heights(), and for a map without a triangle.
tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule,
                             ImageReader& images);

}  // namespace sonarsim
