#pragma once

#include <string>

#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// 32 hexadecimal digits that differ when the scene, its materials or the poses differ: a hash of
/// the contents of the files that a mission names.
std::string inputs_hash(const Assembly& assembly);

}  // namespace sonarsim
