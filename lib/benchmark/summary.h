#pragma once

#include <cstddef>
#include <vector>

namespace sonarsim {

/// Summary of a figure over several poses.
struct Summary {
    double centre = 0.0;  ///< the median of a time, the mean of any other figure
    double min = 0.0;
    double max = 0.0;
};

/// The median, and the extremes. All zero for no values.
Summary median_summary(std::vector<double> values);
/// The mean, and the extremes. All zero for no values.
Summary mean_summary(const std::vector<double>& values);

/// `count` indices into a trajectory, evenly spaced from its first pose to its last; all of them if
/// it has fewer.
std::vector<std::size_t> sample_poses(std::size_t poses, int count);

}  // namespace sonarsim
