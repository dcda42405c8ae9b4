#pragma once

#include "simulate/visibility/view.h"

namespace sonarsim {

/// Limits of columns and samples that keep a view's image within its error goal.
struct StripRule {
    float columns;  ///< parts of each least column, if nothing in view is thin
    float small_m;  ///< pieces that span less range stand as one strip
    float bin_m;
    float range_max_m;
    float sag_m;      ///< largest deviation of a sample's range from the linear one
    float wedge_m;    ///< largest difference of the range spans of a sample's sides
    float taper;      ///< largest difference of a sample's widths, over their sum
    float along_rad;  ///< largest angle that a sample spans along its column
};

StripRule strip_rule(const View& view);

/// Parts of each least column of a frame with such triangles (StripTriangles::thinness).
int column_parts(const StripRule& rule, float thinness);

}  // namespace sonarsim
