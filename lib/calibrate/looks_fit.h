#pragma once

#include <string>
#include <vector>

#include "calibrate/law_fit.h"
#include "calibrate/patch_classes.h"

namespace sonarsim {

/// The skewness of the log powers of noise. The level of noise is known, so the third moment is
/// taken about the mean of a place over all pings; it varies less than one of differences. With too
/// little noise of fine steps, it is the skewness of the law.
Bounded skewness_of_noise(const PatchClasses& classes, const LawFit& law);

/// The number of looks: that of the start, unless the skewness lies 3.3 standard errors off it (one
/// case of 1,000) and agrees with another number. A wrong number scales gamma by half or more.
int fit_looks(const Bounded& skewness, int start, std::vector<std::string>& notes);

}  // namespace sonarsim
