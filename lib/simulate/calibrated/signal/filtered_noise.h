#pragma once

#include <limits>

#include "core/random.h"
#include "simulate/calibrated/signal/fourier.h"
#include "simulate/calibrated/signal/normals.h"

namespace sonarsim {

/// The channels of a receiver. The counter of the random numbers is a bin and a number; it yields
/// two words. The first words of the numbers 0 to `firsts` - 1 make the noise of the first
/// channels, the second words of the numbers 0 to `seconds` - 1 that of the next channels.
struct NoiseChannels {
    int firsts = 0;
    int seconds = 0;

    int count() const { return firsts + seconds; }
};

/// The receiver's noise in the range bins of one ping. Each channel has white complex normal noise,
/// real and imaginary part of variance 1, which then passes a filter along range. The noise depends
/// on the bin, the channel and the key alone.
class FilteredNoise {
  public:
    /// `taps`: 2 reach + 1, with a sum of squares of 1, so that the filter keeps the power.
    FilteredNoise(const NoiseChannels& channels, const std::vector<float>& taps, PhiloxKey key);

    /// Moves to the bins `row` to `row` + 7. White noise is drawn, too, for the bins before the
    /// first and after the last one that the filter reaches.
    void go_to(int row);
    /// The noise of these bins in a channel.
    ComplexLanes of(int channel) const;

  private:
    /// Drops the first 8 bins of the windows and draws 8 bins at their end.
    void draw(int row);
    void put(int channel, const std::uint32_t* words);

    NoiseChannels channels_;
    std::vector<float> taps_;
    PhiloxKey key_;
    int reach_;
    int length_;  ///< bins of a window, a multiple of 8
    int next_row_ = std::numeric_limits<int>::min();
    std::vector<float> windows_;  ///< [channels][real, imaginary][length]: white noise
    std::vector<std::uint32_t> a_, b_;
};

}  // namespace sonarsim
