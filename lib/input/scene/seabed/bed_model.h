#pragma once

#include <tiny_gltf.h>

#include "input/scene/seabed/seabed.h"

namespace sonarsim {

/// A bed as tinygltf's structs, as if it were a glTF of the world, in metres with z up. The node
/// "seabed" has a vertex for each height; four neighbours make two triangles, with the same
/// diagonal as in height_model(), so that an image of the heights is the same surface.
tinygltf::Model bed_model(const Seabed& bed);

}  // namespace sonarsim
