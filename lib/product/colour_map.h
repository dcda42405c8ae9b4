#pragma once

#include <span>

#include "product/picture.h"

namespace sonarsim {

enum class FanColours { grey, copper, amber, sea };

/// The equally spaced stops of a colour map, for blend(). Brightness grows from stop to stop.
std::span<const Rgb> stops_of(FanColours colours);

}  // namespace sonarsim
