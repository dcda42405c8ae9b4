#include "product/colour_map.h"

namespace sonarsim {

namespace {

constexpr Rgb grey_stops[] = {{0, 0, 0}, {255, 255, 255}};
constexpr Rgb copper_stops[] = {{0, 0, 0}, {107, 67, 42}, {204, 127, 81}, {255, 199, 127}};
constexpr Rgb amber_stops[] = {
    {0, 0, 0}, {96, 44, 0}, {196, 112, 8}, {255, 184, 48}, {255, 244, 208}};
constexpr Rgb sea_stops[] = {{10, 4, 36},    {62, 30, 112},  {44, 96, 146},
                             {34, 154, 138}, {140, 208, 84}, {252, 238, 120}};

}  // namespace

std::span<const Rgb> stops_of(FanColours colours) {
    switch (colours) {
        case FanColours::grey:
            return grey_stops;
        case FanColours::copper:
            return copper_stops;
        case FanColours::amber:
            return amber_stops;
        case FanColours::sea:
            return sea_stops;
    }
    return grey_stops;
}

}  // namespace sonarsim
