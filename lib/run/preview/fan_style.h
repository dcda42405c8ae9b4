#pragma once

#include <cstdint>
#include <span>

#include "simulate/ping/sonar.h"
#include "simulate/product/fan.h"
#include "simulate/product/picture.h"

namespace sonarsim {

/// The grey values of render_fan() in amber, with rings of equal range and lines of equal azimuth.
/// Numbers are written where there is room: ranges along the starboard edge of the sector, or along
/// the boresight if it is wider than 180 degrees; bearings in degrees below the largest range, "P"
/// for port and "S" for starboard.
Picture styled_fan(const Sonar& sonar, const FanFrame& frame, std::span<const std::uint8_t> grey);

}  // namespace sonarsim
