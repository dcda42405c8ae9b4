#pragma once

#include <vector>

#include "core/pose.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Parts of a view that cost little to trace: six beams of a fan in two places. Other views are not
/// divided.
std::vector<Sight> parts_of(const View& view, const Pose& T_world_sensor);

}  // namespace sonarsim
