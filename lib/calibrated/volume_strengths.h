#pragma once

#include <optional>

#include "mission/mission.h"

namespace sonarsim {

/// The volume backscattering strength of the water without its layers, dB re 1 m^2 per m^3; nothing
/// if it has none. The levels of `content` are chosen: they divide the range of -90 dB (clear) to
/// -55 dB (dense clouds) that is common for the sea. They do not depend on frequency.
inline std::optional<double> volume_strength_db(const WaterConfig& water) {
    if (water.scattering_db_per_m3) return water.scattering_db_per_m3;
    switch (water.content) {
        case WaterContent::clear:
            return -90.0;
        case WaterContent::coastal:
            return -75.0;
        case WaterContent::plankton:
            return -65.0;
        case WaterContent::plume:
            return -55.0;
        case WaterContent::none:
            break;
    }
    return std::nullopt;
}

}  // namespace sonarsim
