#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "input/mission/instrument.h"
#include "simulate/calibrated/beams/beamformer.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/trace/range_boxes.h"

namespace sonarsim {

/// The sines of the azimuths of a fan's beams, and of the edges between them.
struct BeamSines {
    std::vector<double> middles, edges;  ///< the edges are one more
};

/// The beams that a line array forms. They have the far-field pattern at every range or, with
/// BeamConfig::focus_m, at that one: at others they are wider. A beam receives echoes in its cone;
/// powers are shared between the four cells of the grid around each echo.
class ArrayBeams final : public Beams {
  public:
    ArrayBeams(Beamformer amplitudes, Beamformer powers, ElementNoise noise)
        : amplitudes_(std::move(amplitudes)),
          powers_(std::move(powers)),
          noise_(std::move(noise)) {}

    int columns() const override { return sines()->columns; }
    const SineGrid* sines() const override { return &amplitudes_.grid(); }
    float scalloping_gain() const override { return amplitudes_.scalloping_gain(); }
    std::uint64_t find_columns(const PatchBlock& pieces, PointEchoes& echoes) const override;
    void deposit(const PatchBlock& pieces, const PointEchoes& echoes, const Amplitudes* amplitudes,
                 EchoGrid& grid, EchoGrid* mean) const override;
    void deposit_paths(const PathEndpoint& /*out*/, const PathEndpoint& back,
                       EchoGrid& grid) const override {
        deposit(back.places, back.echoes, nullptr, grid, nullptr);
    }
    void find_received(const PatchBlock& pieces, const PointEchoes& echoes, const PathEndpoint* out,
                       std::vector<ReceivedPiece>& received) const override;
    void form(const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
              std::span<const float> row_gain, std::span<float> image) const override;

  private:
    Beamformer amplitudes_, powers_;
    ElementNoise noise_;
};

/// `sines`: of the beams' azimuths. `noise`: [range bins, to a multiple of 8] the noise power in a
/// beam. `taps`: the noise's filter along range.
std::shared_ptr<const Beams> array_beams(const BeamConfig& beam, const BeamSines& sines,
                                         const RangeBins& bins, double wavelength_m,
                                         std::span<const double> noise,
                                         const std::vector<float>& taps);

}  // namespace sonarsim
