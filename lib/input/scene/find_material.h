#pragma once

#include <algorithm>
#include <span>
#include <string>

#include "input/scene/copy_number.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// The row of a material of a scene: that of its name, else that of its name without the number of
/// a copy, so that "Steel.001" finds "Steel". Null if `rows` has neither.
inline const Material* find_material(std::span<const Material> rows, const std::string& name) {
    for (const std::string& wanted : {name, without_copy_number(name)}) {
        const auto row = std::ranges::find(rows, wanted, &Material::name);
        if (row != rows.end()) return &*row;
    }
    return nullptr;
}

}  // namespace sonarsim
