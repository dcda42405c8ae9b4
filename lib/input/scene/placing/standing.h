#pragma once

#include <string>

#include "input/scene/placed_file.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// True if a surface rests broadly along an axis of its frame: the outline of its lowest
/// hundredth, seen along the axis, covers at least a third of its whole outline. A box stands, and
/// a tyre on its side; a ball, a lying cylinder and a tyre on its tread do not.
bool rests_upright(const Surface& surface, int axis);

/// "metres, y up (no `up` given)": how a file is read.
std::string reading_of(const PlacedFile& file);

/// "tyre.stl lies on its side ...: does its z point up? up: z" for a file that does not say which
/// axis points up, as the user does not, is read as y up, and stands or lies flat only with z up;
/// else "". `surface` is that of the file before it is placed.
std::string up_question(const PlacedFile& file, const Surface& surface);

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
