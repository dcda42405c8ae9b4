#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ping/sonar.h"
#include "product/even_kernel.h"
#include "trace/ping.h"

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

/// Where the centre of a pixel lies.
struct FanPlace {
    double x_m;  ///< ahead
    double y_m;  ///< to port
    double range_m;
    double azimuth_rad;
};
FanPlace fan_place(const FanFrame& frame, double range_max_m, double column, double row);
bool is_inside_sector(const View& view, const FanPlace& place);

/// How the bins of a sonar fall on the pixels of its fan, worked out once per sonar. A pixel is a
/// weighted mean of the bins around it, by the kernel of even_kernel.h in range and in azimuth; a
/// pixel that is larger than the bins takes the mean of those it covers. What lies outside the
/// sector counts as black, so that edges are smooth: the covered share of a pixel on the edge is
/// counted at 64 points.
struct FanMap {
    /// Small, since all of them pass through the caches for every ping.
    struct Pixel {
        std::int32_t first_bin;    ///< of the first taps, into the padded image
        std::uint8_t range_phase;  ///< of its weights in the range kernel
        std::uint8_t beam_phase;   ///< and in the beam kernel
        std::uint8_t covered;      ///< 64ths of the pixel that lie inside the sector
    };
    /// Pixels of a row side by side.
    struct Run {
        std::int32_t index;  ///< of the first one in the picture, row by row
        std::int32_t count;
    };
    /// Pixels that share a beam kernel: the nearer to the apex, the more beams a pixel covers.
    struct Ring {
        KernelTable beam_kernel;
        std::vector<Pixel> pixels;
        std::vector<Run> runs;  ///< where they are, one after the other
    };

    FanFrame frame;
    KernelTable range_kernel;
    std::vector<Ring> rings;
    int range_padding = 0;   ///< rows before the first and after the last bin, so that kernels at
    int beam_padding = 0;    ///< the edges need no case of their own; columns likewise
    bool full_turn = false;  ///< the last beam meets the first
};

/// `width_px` as for fan_frame().
FanMap make_fan_map(const Sonar& sonar, int width_px);

/// The fan as grey values [height, width], row by row from the top. Intensity is power, an
/// operator's display shows amplitude: grey = 255 sqrt(intensity / full_scale), and what exceeds
/// `full_scale` is white.
std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale);

}  // namespace sonarsim
