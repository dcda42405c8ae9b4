#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/calibrated/near_field.h"
#include "simulate/calibrated/sonar_equation.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// Transducers that both transmit and receive, and form no beams: the two sides of a side-scan
/// sonar, the disc of an echosounder, the head of a scanning sonar. A side receives the echoes of
/// all surface, weighted by its pattern.
struct TransducerBeams {
    struct Axis {
        float x, y;  ///< unit, sensor frame
    };
    Aperture aperture = Aperture::piston;
    std::vector<Axis> sides;  ///< starboard and port; empty: one beam, along the boresight
    UnfocusedBeam along;      ///< pattern of a side along the sensor's z axis, two-way
    /// Two-way amplitude of a side across the track, of a disc off its axis, of a head in azimuth.
    SineTable pattern;
    /// [range bins, to a multiple of 8] of the noise, real and imaginary part each.
    std::vector<float> row_sigma;
    std::vector<float> noise_taps{1.0F};

    int beams() const { return sides.empty() ? 1 : static_cast<int>(sides.size()); }
};

/// `noise`: [range bins, to a multiple of 8] the noise power in a beam. `taps`: the noise's filter
/// along range.
TransducerBeams transducer_beams(const BeamConfig& beam, const View& view, double wavelength_m,
                                 std::span<const double> noise, const std::vector<float>& taps);

inline int columns_of(const TransducerBeams& beams) {
    return beams.beams();
}
/// A beam has a column of the grid to itself.
inline const SineGrid* sines_of(const TransducerBeams& /*beams*/) {
    return nullptr;
}
inline float scalloping_gain(const TransducerBeams& /*beams*/) {
    return 1.0F;
}
inline std::uint64_t find_columns(const TransducerBeams& /*beams*/, const PatchBlock& /*pieces*/,
                                  PointEchoes& /*echoes*/) {
    return 0;
}

/// Adds the powers of echoes to the real parts of the grid, shared between two bins.
void add_powers(const TransducerBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                EchoGrid& grid);
/// The same for complex amplitudes. `mean`: a grid that receives the powers; null: none.
void add_amplitudes(const TransducerBeams& beams, const PatchBlock& pieces,
                    const PointEchoes& echoes, const Amplitudes& amplitudes, EchoGrid& grid,
                    EchoGrid* mean = nullptr);

/// Finds the two-way power with which a beam receives an echo of power 1 from each piece.
void find_gains(const TransducerBeams& beams, int beam, const PatchBlock& pieces,
                const PointEchoes& echoes, PatchBlock::Array<float>& gains);

/// True if a piece lies in the main lobe of the narrow pattern: of a side along the track, of a
/// head in azimuth. A disc has no narrow pattern. The main lobe ends at -20 dB two-way: the highest
/// side lobe of an even line array has -26.5 dB.
bool in_main_lobe(const TransducerBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                  int k);

/// Adds the powers of echoes that return from another place than they were sent to: each beam
/// receives only the sound that it has transmitted. The powers and bins are those of `back`.
void add_bistatic_powers(const TransducerBeams& beams, const PathEndpoint& out,
                         const PathEndpoint& back, EchoGrid& grid);

/// Fills the image [bins, beams] with the power of the grid, which holds `powers` or amplitudes,
/// and of the noise. Noise depends on the bin, the beam and the key alone.
void beamform(const TransducerBeams& beams, const EchoGrid& grid, bool powers, bool noisy,
              PhiloxKey key, std::span<const float> row_gain, std::span<float> image);

}  // namespace sonarsim
