#pragma once

#include "core/rgb.h"

namespace sonarsim {

// The equally spaced stops of colour maps, for blend(). Brightness grows from stop to stop.
inline constexpr Rgb copper_colours[] = {{0, 0, 0}, {107, 67, 42}, {204, 127, 81}, {255, 199, 127}};
inline constexpr Rgb amber_colours[] = {
    {0, 0, 0}, {96, 44, 0}, {196, 112, 8}, {255, 184, 48}, {255, 244, 208}};
inline constexpr Rgb sea_colours[] = {{10, 4, 36},    {62, 30, 112},  {44, 96, 146},
                                      {34, 154, 138}, {140, 208, 84}, {252, 238, 120}};

}  // namespace sonarsim
