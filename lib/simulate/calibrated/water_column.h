#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/calibrated/array_beams.h"
#include "simulate/calibrated/transducer_beams.h"
#include "simulate/trace/visible_surface.h"

namespace sonarsim {

/// Directions of equal solid angle, unit, sensor frame.
struct EqualDirections {
    std::vector<Eigen::Vector3f> all;
    float each_sr = 0.0F;
};

/// The directions in which surface is traced, at most `step_rad` of azimuth apart.
EqualDirections traced_directions(const View& view, const GuardBeams& guard_beams, double step_rad);

/// The water's volume scattering, ready for the pings of a sonar; section 5 of docs/calibrated.md.
struct WaterColumn {
    struct Layer {
        float top_m, bottom_m;  ///< below the water's surface
        float strength;         ///< m^2 per m^3
    };
    std::vector<Layer> layers;  ///< strengths of layers that overlap add
    EqualDirections directions;
    int joined_columns = 1;  ///< columns of a line array's grid that receive their water as one
    /// The power of a bin of water of 1 m^2 per m^3 in one steradian, by range bin; 0 after the
    /// last bin, up to a multiple of 8.
    std::vector<float> row_power;
};

/// Nothing if no water scatters. `water`: from water_of(). `view`: with a bin for each sample.
std::optional<WaterColumn> water_column(const WaterConfig& water, double frequency_hz,
                                        const View& view, const GuardBeams& guard_beams,
                                        const std::variant<TransducerBeams, ArrayBeams>& beams,
                                        const SonarEquation& equation);

}  // namespace sonarsim
