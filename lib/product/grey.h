#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// Converts intensities to 16-bit grey values: round(65535 intensity / full_scale), white above
/// full_scale.
std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale);

}  // namespace sonarsim
