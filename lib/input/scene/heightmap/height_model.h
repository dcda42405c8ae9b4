#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <vector>

#include "input/scene/placed_file.h"

namespace sonarsim {

/// Heights of a map, row by row; NaN: unknown.
struct HeightGrid {
    std::size_t columns = 0, rows = 0;
    std::vector<float> values;

    /// Heights between those of the grid, which stay, by cubic convolution (Keys 1981, a = -1/2:
    /// exact for parabolas): `across` - 1 between two columns, `down` - 1 between two rows. Beyond
    /// the border and unknown heights it continues straight. A height beside one is unknown.
    HeightGrid interpolated(std::size_t across, std::size_t down) const;
};

/// Reads an image of heights as tinygltf's structs, as if it were a glTF with z up and one node
/// "heightmap". Only the rule's window of a larger map is read. A vertex stands at the centre of
/// each pixel; four neighbours make two triangles that share the edge from the first row and column
/// to the next row and column. A triangle needs three known heights. With the rule's cell_m there
/// are more vertices between the pixels (HeightGrid::interpolated). Positions are (column, row,
/// value); the node's matrix turns them into the map's coordinates, so that maps far from their
/// origin lose nothing.
/// InputError as read_image(), for an image of several channels, one whose place is not known or in
/// degrees, values that are not heights, and a map without a triangle.
tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule);

}  // namespace sonarsim
