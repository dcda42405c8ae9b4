#pragma once

#include <string>

namespace sonarsim {

/// The least lengths, in ranges of the sonars, of what may be a file of another unit: an object is
/// rarely longer than what two sonars see from its middle, and a place often is.
inline constexpr double long_object = 2.0;
inline constexpr double long_place = 300.0;
/// The range that stands for those of a mission where there is none, m.
inline constexpr double usual_range_m = 50.0;

/// "650 m long: millimetres? units: mm" for what is read in metres, is longer than `ranges` times
/// `range_m`, and in millimetres would be shorter than the range; the same for what is read in
/// millimetres and should be in metres. "" for anything else.
std::string unit_question(double length_m, double unit_m, double range_m, double ranges);

}  // namespace sonarsim
