#pragma once

#include <Eigen/Core>
#include <optional>

#include "input/mission/mission.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/trace/visible_surface.h"

namespace sonarsim {

/// The water of an instrument: `auto` values become those of the instrument's usual water.
WaterConfig water_of(const WaterConfig& water, const InstrumentConfig& instrument);

/// The volume scattering cross-section of the water without its layers, m^2 per m^3: plankton and
/// bubbles (the same at all frequencies) and suspended particles; `water.content` is not `auto`.
///
/// The levels of `content` are chosen: they divide the range of -90 dB (clear) to -55 dB (dense
/// clouds) common in the sea. Suspended particles: 0.5 mg/l off the coast, 5 to 50 near it.
double volume_strength(const WaterConfig& water, double frequency_hz);

/// The backscattering cross-section of particles of quartz, m^2 per m^3 of water:
///
///     s_v = 3 M f^2 / (16 pi rho a)
///
/// M is their mass per volume of water, rho their density, a their radius: M / (4/3 pi rho a^3)
/// particles of a^2 f^2 / 4 each. The form function f of sand is that of P. D. Thorne and R. Meral,
/// "Formulations for the scattering properties of suspended sandy sediments", Cont. Shelf Res. 28
/// (2008), 309: 1.25 (k a)^2 of particles much smaller than a wavelength, 1.1 of large ones.
double suspended_strength(double mg_per_l, double diameter_um, double wavenumber);

/// Directions of equal solid angle, unit, sensor frame.
struct EqualDirections {
    std::vector<Eigen::Vector3f> all;
    float each_sr = 0.0F;
};

/// The water's volume scattering, ready for the pings of a sonar; section 3 of docs/calibrated.md.
struct WaterColumn {
    struct Layer {
        float top_m, bottom_m;  ///< below the water's surface
        float strength;         ///< m^2 per m^3
    };
    std::vector<Layer> layers;  ///< strengths of layers that overlap add
    EqualDirections directions;
    int joined_columns = 1;  ///< columns of a line array's grid that receive their water as one
    /// The power of 1 m^2 per m^3 of water in one steradian, by range bin; 0 up to a multiple of 8.
    std::vector<float> row_power;
};

/// Nothing if no water scatters. `water`: from water_of(). `view`: with a bin for each sample.
std::optional<WaterColumn> water_column(const WaterConfig& water,
                                        const InstrumentConfig& instrument, const View& view,
                                        const Beams& beams, const SonarEquation& equation);

}  // namespace sonarsim
