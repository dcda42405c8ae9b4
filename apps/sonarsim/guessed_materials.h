#pragma once

#include <string>
#include <vector>

#include "input/scene/scene.h"

namespace sonarsim {

/// A CSV of materials that is a first guess.
struct GuessedMaterials {
    std::string csv;                   ///< a guess has a comment above its row
    std::vector<std::string> guesses;  ///< "material Hull_paint: steel"
    std::string default_material;      ///< for surfaces without a material; "": there are none
};

/// Rows for the materials of a mesh and for the others that are named, `beds`, from the table
/// scenes/materials.csv of the program: that of the same name, else that of the longest word in
/// it ("Hull_wood.001": wood), else that of steel, or of sand for a bed. InputError when the table
/// is missing.
GuessedMaterials guess_materials(const Scene& mesh, const std::vector<std::string>& beds);

}  // namespace sonarsim
