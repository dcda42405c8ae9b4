#pragma once

#include <cstdint>
#include <string_view>

#include "trace/ping.h"

namespace sonarsim {

/// The brightest pixel of a ping. std::runtime_error that names the sensor and the pose when any
/// pixel is NaN or infinite: such an image must never reach the disk.
float brightest_pixel(const Ping& ping, std::string_view sensor, std::uint32_t pose);

}  // namespace sonarsim
