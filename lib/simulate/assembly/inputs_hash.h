#pragma once

#include <string>

#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// 32 hexadecimal digits that differ when a file that the mission names, the scene's surface or the
/// poses differ.
std::string inputs_hash(const Assembly& assembly);

}  // namespace sonarsim
