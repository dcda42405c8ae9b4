#pragma once

#include "simulate/labels/mask_window.h"

namespace sonarsim {

/// Fills the convex hull of a shape of values other than 0 with ones, as a person draws around a
/// compact body of which a part is missing, if the shape covers most of it; else that of each of
/// its pieces for which this holds. In a fan, lines are straight in the plane of the picture.
void fill_hulls(const MaskFrame& frame, MaskWindow& shape);

}  // namespace sonarsim
