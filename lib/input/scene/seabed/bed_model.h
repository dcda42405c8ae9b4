#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

#include "input/scene/seabed/seabed.h"

namespace sonarsim {

/// The surface of a bed without its rocks.
struct BedGround {
    std::vector<float> vertices;  ///< column, row and height of each
    /// [materials, then mixtures_of()][3 * triangles]
    std::vector<std::vector<std::uint32_t>> corners;
};

/// A vertex for each height, then those of the borders. Four heights make two triangles, with the
/// same diagonal as in height_model(), so that an image of the heights is the same surface. Borders
/// of sediments cut triangles, and change neither the surface nor that it is closed.
BedGround ground_of(const Seabed& bed);

/// A bed as structs of tinygltf, of the world, in metres with z up. Its node is "seabed".
tinygltf::Model bed_model(const Seabed& bed);

}  // namespace sonarsim
