#pragma once

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/calibrated/equation/sonar_equation.h"
#include "simulate/calibrated/signal/echo_grid.h"
#include "simulate/trace/cone_beams.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// A beam that receives a piece of a block in its main lobe.
struct ReceivedPiece {
    int beam, piece;
    float power;
};

/// The beams that a line array forms, or transducers that form none. Immutable.
class Beams {
  public:
    virtual ~Beams() = default;

    ConeBeams cones;  ///< the beams of a line array; none of transducers

    /// The columns of the grid of echoes, and their sines; null: a beam has a column to itself.
    virtual int columns() const = 0;
    virtual const SineGrid* sines() const { return nullptr; }
    /// Scalloping correction: mean power over positions between columns / power at a column.
    virtual float scalloping_gain() const { return 1.0F; }
    /// Finds the columns of echoes. Echoes outside the grid get the power 0; returns their number.
    virtual std::uint64_t find_columns(const PatchBlock& /*pieces*/,
                                       PointEchoes& /*echoes*/) const {
        return 0;
    }

    /// Adds the echoes of a block to a grid: their amplitudes or, without any, their powers, to
    /// the real parts. `mean`: a grid that receives the powers, too; null: none.
    virtual void deposit(const PatchBlock& pieces, const PointEchoes& echoes,
                         const Amplitudes* amplitudes, EchoGrid& grid, EchoGrid* mean) const = 0;
    /// Adds echoes that return from another place than they were sent to: `back` has the powers.
    virtual void deposit_paths(const PathEndpoint& out, const PathEndpoint& back,
                               EchoGrid& grid) const = 0;

    /// Finds the two-way power with which a column receives an echo of power 1 from each piece.
    virtual void find_gains(int /*column*/, const PatchBlock& /*pieces*/,
                            const PointEchoes& /*echoes*/, PatchBlock::Array<float>& gains) const {
        gains.fill(1.0F);
    }
    /// Adds the beams that receive a block's echoes in their main lobes, with the powers. `out`:
    /// the places to which the sound was sent; null: the pieces.
    virtual void find_received(const PatchBlock& pieces, const PointEchoes& echoes,
                               const PathEndpoint* out,
                               std::vector<ReceivedPiece>& received) const = 0;
    /// The share of the pattern along the track that a view receives; 1 where gains have it all.
    virtual double mean_along_track(const View& /*view*/, double /*range_m*/) const { return 1.0; }

    /// Fills the image [bins, beams] with the powers of the beams, and of noise if it is `noisy`.
    /// The grid holds `powers` or amplitudes. Noise is a function of its place and the key.
    virtual void form(const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
                      std::span<const float> row_gain, std::span<float> image) const = 0;
};

/// The sines of the azimuths of a fan's beams, and of the edges between them.
struct BeamSines {
    std::vector<double> middles, edges;  ///< the edges are one more
};

/// The beams that a line array forms. They have the far-field pattern at every range or, with
/// BeamConfig::focus_m, at that one: at others they are wider. A beam receives echoes in its cone;
/// powers are shared between the four cells of the grid around each echo. `noise`: [range bins, to
/// a multiple of 8] the noise power in a beam. `taps`: the noise's filter along range.
std::shared_ptr<const Beams> array_beams(const BeamConfig& beam, const BeamSines& sines,
                                         const RangeBins& bins, double wavelength_m,
                                         std::span<const double> noise,
                                         const std::vector<float>& taps);

/// Transducers that both transmit and receive, and form no beams: the two sides of a side-scan
/// sonar, the disc of an echosounder, the head of a scanning sonar. A side receives the echoes of
/// all surface, weighted by its pattern, and over two surfaces only the sound that it has
/// transmitted; powers are shared between two bins. `noise` and `taps` as above.
std::shared_ptr<const Beams> transducer_beams(const BeamConfig& beam, const View& view,
                                              double wavelength_m, std::span<const double> noise,
                                              const std::vector<float>& taps);

}  // namespace sonarsim
