#pragma once

#include <array>
#include <span>

#include "mission/mission.h"
#include "product/picture.h"

namespace sonarsim {

/// The equally spaced stops of a colour map, for blend(). Brightness grows from stop to stop.
std::span<const Rgb> stops_of(FanColours colours);

/// The colours of the 256 grey values.
using ColourTable = std::array<Rgb, 256>;
ColourTable colour_table(FanColours colours);

}  // namespace sonarsim
