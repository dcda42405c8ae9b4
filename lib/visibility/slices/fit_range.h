#pragma once

#include <Eigen/Core>

#include "visibility/engine.h"
#include "visibility/slices/scan.h"

namespace sonarsim {

/// Fits a sample's parallelogram to `range`, m, the ranges of the four corners of its surface, so
/// that it fills the bins that the surface fills, and no others. The deeper edge is lengthened and
/// moved, by at most half. Returns the interval of range that the parallelogram covers.
Interval fit_range(const Eigen::Array4f& range, Sample& sample);

}  // namespace sonarsim
