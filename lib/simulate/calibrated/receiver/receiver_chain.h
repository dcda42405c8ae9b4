#pragma once

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/calibrated/speckle/speckle.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

// The stages of a receiver after beams and gain (docs/calibrated.md, section 5), off by default.

struct ImageRows {
    double range_min_m = 0.0;
    double bin_m = 1.0;
    double bin_s = 1.0;    ///< two-way time of a bin
    double pulse_s = 0.0;  ///< length of a pulse
    int rows = 0;
    int beams = 0;
    std::span<const float> noise;  ///< [rows] the value of the mean noise before the converter
};

/// Adds values to the bins of the first rows.
void add_to_rows(std::span<const float> values, const ImageRows& rows, std::span<float> image);

/// Adds to the amplitude of each beam what leaks from the beams that channels receive together with
/// it, every `channel_beams`-th: all of these are insonified at once. `image` has powers; their
/// phases are drawn, so that noise and speckle stay Rayleigh.
void add_leaks(const ReceiverConfig& receiver, int beams, PhiloxKey key, std::span<float> image);
/// The same of mean powers.
void add_mean_leaks(const ReceiverConfig& receiver, int beams, std::span<float> image);

/// Adds ringing and foreign pulses, weakens pings, and applies the gains of beams.
void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image);

/// The gains for powers of echoes from directions of these sines: the lobe of an element weakens
/// echoes towards the edges of a fan, and not the receiver's noise. Empty: none are weakened.
std::vector<float> edge_gains(const ReceiverConfig& receiver, std::span<const double> sines,
                              double azimuth_rad);

/// The gain of a beam, dB, the same in all pings.
double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws);

/// The integers of `bits` bits that the instrument delivers. The powers are relative to full scale
/// and clipped at 1. A is the root of a power, M the greatest integer; `offset` M is subtracted:
///
///     gamma     M A^gamma
///     log       M (1 + 20 log10(A) / dynamic_range_db), 0 below
///     linear    M A
std::vector<std::uint16_t> companded(std::span<const float> powers, const ReceiverConfig& receiver);

/// Sound that arrives behind an echo over many paths: in the sonar's housing, among waves, grains
/// and walls. The energy of this tail is `share` times the echo's, and it falls by 60 dB in T60:
///
///     r_k = d r_(k-1) + (1 - d) share p_(k-1),    d = 10^(-6 t / T60), t = 2 dr / c per bin,
///
/// with p the power of an echo and r that of the tail (Kuttruff, Room Acoustics).
struct Reverberation {
    float share = 0.0F;  ///< 0: none
    float decay = 0.0F;  ///< d

    Reverberation() = default;
    Reverberation(const ReceiverConfig& receiver, double bin_m, double sound_speed_m_s);
};

/// Adds the tails of a column's echoes to the mean powers that are drawn for each ping, which have
/// tails, too; both by bin, before the pulse. Negligible powers become 0. `echoes`: mean powers in
/// the first of two floats (EchoGrid::column), read only if there are tails.
void add_tails(const Reverberation& tail, const float* echoes, std::span<float> drawn);

/// The value that an instrument delivers of the n independent samples of which it makes a range
/// bin: their largest power, or their mean power. One sample is rendered, and its rank among the
/// draws of its mean is kept: with exponential powers the rank of the power x (in means) is 1 -
/// e^-x, and the delivered value y (in means of what is delivered) is the quantile of that rank of
///
///     max:  P(y < v) = (1 - e^-v)^n,      so that y = -ln(1 - (1 - e^-x)^(1/n)) / mean
///     mean: the gamma distribution of shape n.
///
/// n need not be whole. Then y becomes y^`expansion` over its mean, as if the instrument stretched
/// the decibels of a sample about their mean. The mean of all values stays.
class DetectedSample {
  public:
    DetectedSample() = default;  ///< one sample
    explicit DetectedSample(const ReceiverConfig& receiver);

    bool changes() const { return !value_.empty(); }
    /// Replaces powers; `mean` has the mean of each of them over all draws.
    void apply(std::span<const float> mean, std::span<float> power) const;

  private:
    std::vector<float> value_;  ///< y by log2 x in equal steps
    float last_gain_ = 1.0F;    ///< y / x at the end of the table, and beyond
};

}  // namespace sonarsim
