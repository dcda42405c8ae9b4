#pragma once

#include <span>
#include <vector>

#include "input/mission/instrument.h"

namespace sonarsim {

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
