#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "support/lattices.h"

namespace sonarsim::test {

/// A mesh that somebody else made.
struct ForeignMesh {
    std::string name;
    Scene scene;
};

/// The .glb files of a folder with 150 to 300,000 triangles, by name. Files that the program
/// refuses are left out.
std::vector<ForeignMesh> foreign_meshes(const std::string& folder);

/// Draws scene `number` as draw_lattice() does, with one of the meshes in place of a shape. Its
/// materials have drawn reflections.
Lattice draw_foreign_mesh(std::uint32_t number, const std::vector<ForeignMesh>& meshes);

}  // namespace sonarsim::test
