#pragma once

#include <Eigen/Core>

#include "visibility/engine.h"
#include "visibility/slices/scan.h"

namespace sonarsim {

/// Makes a sample's parallelogram reach from the least to the greatest of `range`, m: that of the
/// four corners of the surface that it stands for. It lights the bins that the surface reaches, and
/// no others. Its deeper edge is lengthened and moved, by no more than half.
/// Returns the range that it reaches over.
Extent fit_range(const Eigen::Array4f& range, Sample& sample);

}  // namespace sonarsim
