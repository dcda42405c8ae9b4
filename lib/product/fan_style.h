#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "product/colour_map.h"
#include "product/fan.h"
#include "product/picture.h"

namespace sonarsim {

/// The style of a sonar's fans, made once: a colour map, rings of equal range and lines of equal
/// azimuth. Ranges are written along the starboard edge of the sector, or along the boresight if
/// it is wider than 180 degrees; bearings below the largest range, "P" for port and "S" for
/// starboard. The frame is that of the plain fan, so that boxes still fit.
struct FanStyle {
    /// A colour that is blended over a pixel with the weight `share`.
    struct Mark {
        std::int32_t index;
        Rgb colour;
        float share;
    };

    FanFrame frame;
    ColourTable colours;
    std::vector<Mark> marks;  ///< in the order in which they are drawn
};

/// `numbers`: also draws fan_numbers(), in the small letters of product/picture.h.
FanStyle make_fan_style(const Sonar& sonar, const FanFrame& frame, const FanStyleConfig& config,
                        bool numbers = true);

/// A number at a ring or at a bearing.
struct FanNumber {
    int x = 0;  ///< pixel of its middle
    int y = 0;
    std::string value;  ///< metres of a ring, degrees of a bearing
    std::string side;   ///< "P", "S" or, for rings and for 0 and 180 degrees, ""
    bool is_bearing = false;
};

/// The numbers for which there is room.
std::vector<FanNumber> fan_numbers(const Sonar& sonar, const FanFrame& frame,
                                   const FanStyleConfig& config);

/// Draws the grey values of render_fan() in this style.
Picture styled_fan(const FanStyle& style, std::span<const std::uint8_t> grey);

}  // namespace sonarsim
