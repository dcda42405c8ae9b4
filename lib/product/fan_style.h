#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "product/colour_map.h"
#include "product/fan.h"
#include "product/picture.h"

namespace sonarsim {

/// How the fans of a sonar are drawn, worked out once: a colour map, and rings of equal range and
/// lines of equal azimuth over it. Their numbers stand beside the starboard edge of the sector (of
/// one wider than 180 degrees beside the boresight) and below the outermost range; "P" is port,
/// "S" starboard. Nothing of the frame changes, so that boxes in the fan still fit.
struct FanStyle {
    /// A pixel that is drawn over, `share` of it.
    struct Mark {
        std::int32_t index;
        Rgb colour;
        float share;
    };

    FanFrame frame;
    ColourTable colours;
    std::vector<Mark> marks;  ///< in the order in which they are drawn
};

FanStyle make_fan_style(const Sonar& sonar, const FanFrame& frame, const FanStyleConfig& config);

/// The grey values of render_fan() as a picture.
Picture styled_fan(const FanStyle& style, std::span<const std::uint8_t> grey);

}  // namespace sonarsim
