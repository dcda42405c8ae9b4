#pragma once

#include "mission/mission.h"

namespace sonarsim {

/// True if the water sends sound back.
inline bool scatters(const WaterConfig& water) {
    return water.content != WaterContent::none || water.scattering_db_per_m3 ||
           !water.layers.empty();
}

}  // namespace sonarsim
