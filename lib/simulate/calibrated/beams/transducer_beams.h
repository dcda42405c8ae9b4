#pragma once

#include <span>
#include <vector>

#include "input/mission/instrument.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/calibrated/signal/near_field.h"

namespace sonarsim {

/// Transducers that both transmit and receive, and form no beams: the two sides of a side-scan
/// sonar, the disc of an echosounder, the head of a scanning sonar. A side receives the echoes of
/// all surface, weighted by its pattern; powers are shared between two bins.
class TransducerBeams final : public Beams {
  public:
    /// `noise`: [range bins, to a multiple of 8] the noise power in a beam. `taps`: the noise's
    /// filter along range.
    TransducerBeams(const BeamConfig& beam, const View& view, double wavelength_m,
                    std::span<const double> noise, const std::vector<float>& taps);

    int columns() const override { return sides_.empty() ? 1 : static_cast<int>(sides_.size()); }
    void deposit(const PatchBlock& pieces, const PointEchoes& echoes, const Amplitudes* amplitudes,
                 EchoGrid& grid, EchoGrid* mean) const override;
    /// Each beam receives only the sound that it has transmitted.
    void deposit_paths(const PathEndpoint& out, const PathEndpoint& back,
                       EchoGrid& grid) const override;
    void find_gains(int beam, const PatchBlock& pieces, const PointEchoes& echoes,
                    PatchBlock::Array<float>& gains) const override;
    void find_received(const PatchBlock& pieces, const PointEchoes& echoes, const PathEndpoint* out,
                       std::vector<ReceivedPiece>& received) const override;
    double mean_along_track(const View& view, double range_m) const override;
    void form(const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
              std::span<const float> row_gain, std::span<float> image) const override;

  private:
    struct Axis {
        float x, y;  ///< unit, sensor frame
    };

    void find_weights(int beam, const PatchBlock& pieces, const PointEchoes& echoes,
                      Amplitudes& out) const;
    template <class Use>
    void for_each_weight(const PatchBlock& pieces, const PointEchoes& echoes, Use use) const;
    bool in_main_lobe(const PatchBlock& pieces, const PointEchoes& echoes, int k) const;

    Aperture aperture_ = Aperture::piston;
    std::vector<Axis> sides_;  ///< starboard and port; empty: one beam, along the boresight
    UnfocusedBeam along_;      ///< pattern of a side along the sensor's z axis, two-way
    /// Two-way amplitude of a side across the track, of a disc off its axis, of a head in azimuth.
    SineTable pattern_;
    /// [range bins, to a multiple of 8] of the noise, real and imaginary part each.
    std::vector<float> row_sigma_;
    std::vector<float> noise_taps_{1.0F};
};

}  // namespace sonarsim
