#pragma once

#include <span>

#include "input/mission/mission.h"
#include "simulate/product/picture.h"

namespace sonarsim {

/// The layout of a strip: a picture of all pings of a sonar with an axis of ranges, px.
struct StripFrame {
    int axis_width = 0;   ///< 0: no axis on the left
    int axis_height = 0;  ///< 0: no axis on top
    int ping_px = 1;      ///< size of a ping
    int bin_px = 1;       ///< size of a range bin
    int width = 0;        ///< with the axis
    int height = 0;
};

/// The functions that draw a strip for people. Where pings are rows the axis is on top, where they
/// are columns it is on the left.
struct StripStyle {
    StripFrame (*frame)(const SonarConfig& config, int pings);
    /// The axis alone.
    Picture (*axis)(const SonarConfig& config, const StripFrame& frame);
    /// A row of values: a ping, or a range bin over all pings. `white` is the intensity of the
    /// brightest colour; `pixels` is the row without the axis on its left.
    void (*row)(std::span<const float> values, double white, const StripFrame& frame,
                std::span<Rgb> pixels);
};

}  // namespace sonarsim
