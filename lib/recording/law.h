#pragma once

#include <span>
#include <vector>

#include "recording/recording.h"

namespace sonarsim {

/// The largest value that the instrument delivers; 0: not known.
inline double largest_value(const RecordedLaw& law) {
    return law.full_value * (1.0 - law.offset);
}

/// Takes the largest value that samples can hold, 0 for floats, unless the full value is given.
inline void take_full_value(double of_samples, RecordedLaw& law) {
    if (law.full_value_is_auto && of_samples > 0.0) law.full_value = of_samples;
}

/// The power A^2 that a value stands for, 1 for the largest_value() (for the value 1 where the law
/// has no `full_value`). A value of 0 has the power 0, but for `decibel` that of the lowest level.
double power_of(const RecordedLaw& law, double value);

/// power_of() of all values of a ping.
std::vector<float> powers_of(const RecordedLaw& law, std::span<const float> values);

}  // namespace sonarsim
