#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ping/ping.h"
#include "sonar/sonar.h"

namespace sonarsim {

/// Where the fan of a sonar lies in its image: boresight up, port on the left, the apex in the
/// middle column and `range_max / pixel_m` pixels below the upper edge. That is the lower edge,
/// unless the sector is wider than 180 degrees.
struct FanFrame {
    int width = 0;   ///< px
    int height = 0;  ///< px, at most twice the width
    double pixel_m = 0.0;
};

/// The frame of an image exactly `width_px` wide; a narrow sector is centred in it. 0 stands for
/// one pixel per range bin, at most 1024.
FanFrame fan_frame(const Sonar& sonar, int width_px);

/// How the bins of a sonar fall on the pixels of its fan, worked out once per sonar. A pixel is the
/// mean of the bins that it covers, weighted by area; what lies outside the sector counts as black,
/// so that edges are smooth. Areas are counted at 16 points of the pixel, 64 where bins are small.
struct FanMap {
    /// Pixels that cover the same number of bins, so that the inner loops have a fixed length.
    /// Tap k of the group's pixel p is taps[first_tap + k * pixels + p].
    struct Group {
        std::size_t taps_per_pixel;
        std::size_t first_pixel;
        std::size_t pixels;
        std::size_t first_tap;
    };

    FanFrame frame;
    std::vector<Group> groups;
    std::vector<std::int32_t> pixel;  ///< index into the image, row by row
    std::vector<std::uint32_t> taps;  ///< a bin and its weight, packed
};

/// `width_px` as for fan_frame(). At most 2^26 bins.
FanMap make_fan_map(const Sonar& sonar, int width_px);

/// The fan as grey values [height, width], row by row from the top. Intensity is power, an
/// operator's display shows amplitude: grey = 255 sqrt(intensity / full_scale), and what exceeds
/// `full_scale` is white.
std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale);

}  // namespace sonarsim
