#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "input/mission/instrument.h"
#include "simulate/calibrated/beamformer.h"
#include "simulate/calibrated/sonar_equation.h"

namespace sonarsim {

/// The beams that a line array forms. They have the far-field pattern at every range: the
/// instrument is assumed to focus.
struct ArrayBeams {
    Beamformer amplitudes, powers;
    ElementNoise noise;
};

/// `beam_sines`: the sines of the beams' azimuths. `noise`: [range bins, to a multiple of 8] the
/// noise power in a beam. `taps`: the noise's filter along range.
ArrayBeams array_beams(const BeamConfig& beam, const std::vector<double>& beam_sines,
                       std::span<const double> noise, const std::vector<float>& taps);

inline int columns_of(const ArrayBeams& beams) {
    return beams.amplitudes.grid().columns;
}
/// The sines of the columns.
inline const SineGrid* sines_of(const ArrayBeams& beams) {
    return &beams.amplitudes.grid();
}
/// The scalloping correction across the columns: mean power over positions between two columns /
/// power at a column.
inline float scalloping_gain(const ArrayBeams& beams) {
    return beams.amplitudes.scalloping_gain();
}

/// Finds the columns of echoes. Echoes outside the grid get the power 0; returns their number.
std::uint64_t find_columns(const ArrayBeams& beams, const PatchBlock& pieces, PointEchoes& echoes);

/// Adds powers to the real parts of the grid, shared between the four cells around each echo.
void add_powers(const ArrayBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                EchoGrid& grid);
/// The same for complex amplitudes. `mean`: a grid that receives the powers; null: none.
void add_amplitudes(const ArrayBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                    const Amplitudes& amplitudes, EchoGrid& grid, EchoGrid* mean = nullptr);

/// Adds the powers of echoes that return from another place than they were sent to. The columns and
/// powers are those of `back`.
inline void add_bistatic_powers(const ArrayBeams& beams, const PathEndpoint& /*out*/,
                                const PathEndpoint& back, EchoGrid& grid) {
    add_powers(beams, back.places, back.echoes, grid);
}

/// Fills the image [bins, beams] with the powers of the beams. The grid holds `powers` or
/// amplitudes. The noise of an element depends on the bin, the element and the key alone.
void beamform(const ArrayBeams& beams, const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
              std::span<const float> row_gain, std::span<float> image);

}  // namespace sonarsim
