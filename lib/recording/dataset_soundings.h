#pragma once

#include "recording/dataset_source.h"
#include "recording/recording.h"

namespace sonarsim {

/// Adds the soundings of a profiling sonar that have a quality of 0.5 or more, as a map takes them.
/// Angles are the azimuths of the beams of a sonar that looks down; intensities are the values of
/// the files of `pattern` in the bins of the ranges.
void read_dataset_soundings(const DatasetSource& source, const std::string& pattern,
                            Recording& recording);

}  // namespace sonarsim
