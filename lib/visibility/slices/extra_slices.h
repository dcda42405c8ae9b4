#pragma once

#include "visibility/slices/scan.h"
#include "visibility/slices/setup.h"

namespace sonarsim {

/// Adds slices to a frame for the pieces of the scene that lie between two slices: a wire, a small
/// ball. False when there are none.
bool add_extra_slices(const SliceScene& scene, SliceFrame& frame);

}  // namespace sonarsim
