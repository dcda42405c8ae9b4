#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ping/sonar.h"
#include "preview/labels.h"
#include "product/colour_map.h"
#include "product/fan.h"
#include "product/picture.h"

namespace sonarsim {

/// The style of a sonar's fans in a preview: amber, with rings of equal range and lines of equal
/// azimuth.
struct FanStyle {
    /// A colour that is blended over a pixel with the weight `share`.
    struct Mark {
        std::int32_t index;
        Rgb colour;
        float share;
    };

    FanFrame frame;
    ColourTable colours;
    std::vector<Mark> marks;
};
FanStyle make_fan_style(const Sonar& sonar, const FanFrame& frame);

/// The numbers for which there is room: ranges along the starboard edge of the sector, or along the
/// boresight if it is wider than 180 degrees; bearings in degrees below the largest range, "P" for
/// port and "S" for starboard.
std::vector<PictureText> fan_numbers(const Sonar& sonar, const FanFrame& frame);

/// Draws the grey values of render_fan() in this style.
Picture styled_fan(const FanStyle& style, std::span<const std::uint8_t> grey);

}  // namespace sonarsim
