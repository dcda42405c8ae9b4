#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "product/fan.h"

namespace sonarsim {

/// The fans of several pings of one sonar side by side, the first on the left: grey values
/// [height, pings * width].
std::vector<std::uint8_t> render_panels(const FanMap& map, std::span<const Ping> pings,
                                        double full_scale);

}  // namespace sonarsim
