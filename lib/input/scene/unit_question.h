#pragma once

#include <string>

namespace sonarsim {

/// The least lengths, in ranges of the sonars, of files that may have been read in the wrong unit.
/// An object is rarely longer than two ranges, but a place often is.
inline constexpr double long_object = 2.0;
inline constexpr double long_place = 300.0;
/// The range for a mission without sonars, m.
inline constexpr double usual_range_m = 50.0;

/// "650 m long: millimetres? units: mm" for a length that is read in metres, is more than `ranges`
/// times `range_m`, and in millimetres would be less than the range; likewise for one that is read
/// in millimetres and should be in metres. "" for any other.
std::string unit_question(double length_m, double unit_m, double range_m, double ranges);

}  // namespace sonarsim
