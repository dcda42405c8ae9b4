#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/error.h"
#include "scene/images/read_image.h"

namespace sonarsim {

/// Several images as one, from the left to the right.
struct SideBySide {
    Image image;  ///< with an alpha channel, which is 0 below images of less height
    /// The place of each in shares of the whole width and height; (0, 0) is the north-west corner.
    std::vector<Eigen::AlignedBox2d> places;
};

/// InputError if images differ in kind (colours or numbers, whole or float) or in bits, if one has
/// more than 4 channels, and if the whole has more than `most_image_values`.
SideBySide side_by_side(const std::vector<Image>& images, const Location& where);

}  // namespace sonarsim
