#pragma once

#include <string>

#include "input/mission/mission.h"
#include "output/dataset/json.h"
#include "output/dataset/layout.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

inline constexpr const char* dataset_format = "sonarsim dataset";
inline constexpr int dataset_format_version = 3;

/// dataset.json with `complete` set to false. Lengths in metres, angles in radians, edges from the
/// lowest bin to the highest: bin i lies between edges i and i + 1.
Json describe_dataset(const Mission& mission, const Assembly& assembly, const Layout& layout);

/// The block `build` of dataset.json: this program.
Json describe_build();

/// mission.resolved.yaml: the mission with paths from the folder of the scene file on, and the
/// SHA-256 of what it read in comments. The same wherever mission and dataset lie.
std::string resolved_text(const Mission& mission, const Assembly& assembly);

/// 32 hexadecimal digits that differ when an input file, the scene's surface or the poses differ.
std::string inputs_hash(const Assembly& assembly);

}  // namespace sonarsim
