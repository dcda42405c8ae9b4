#pragma once

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "calibrated/sight_cells.h"
#include "calibrated/speckle.h"
#include "core/pose.h"
#include "mission/mission.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// The range or depth of an end that the water does not have.
inline constexpr float no_end = std::numeric_limits<float>::infinity();

/// The water's volume scattering, ready for the pings of a sonar; section 5 of docs/calibrated.md.
struct WaterColumn {
    struct Layer {
        float top_m, bottom_m;  ///< below the water's surface
        float strength;         ///< m^2 per m^3
    };
    float strength = 0.0F;  ///< m^2 per m^3 without the layers
    std::vector<Layer> layers;
    WeightedCells sight;
    float range_min_m = 0.0F, bin_m = 1.0F;
    /// The power of a bin of water of 1 m^2 per m^3 in one steradian, by range bin; 0 after the
    /// last bin, up to a multiple of 8.
    std::vector<float> row_power;
};

/// Nothing if no water scatters. `water`: from water_of(). `view`: the view in which surface is
/// traced, with its guard beams.
std::optional<WaterColumn> water_column(const WaterConfig& water, double frequency_hz,
                                        const View& view,
                                        const std::variant<TransducerBeams, ArrayBeams>& beams,
                                        const SonarEquation& equation);

/// The range at which the surface ends the water of each cell; infinite if it does not.
std::vector<float> water_ends(const SightCells& cells, const TracedPing& traced);

/// The mean scattering that the channels receive, [channels, rows + 1], weighted as WeightedCells
/// are. The last entry of a channel is unused. `surface_z_m`: the height of the water's surface in
/// the world, if there is one.
std::vector<float> received_water(const WaterColumn& water, std::span<const float> ends_m,
                                  const Pose& T_world_sensor,
                                  const std::optional<double>& surface_z_m, int rows);

/// Adds the water's echoes to a grid. Its columns are the sines `by_sine` of a line array or, if
/// this is null, the beams. `gain`: as in draw_speckle(), for amplitudes.
void add_water(const WaterColumn& water, std::span<const float> received, const SineGrid* by_sine,
               PowerForm form, float gain, PhiloxKey key, EchoGrid& grid);

}  // namespace sonarsim
