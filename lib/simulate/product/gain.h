#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// Finds the brightness of a picture from all of its intensities.
class Gain {
  public:
    Gain();
    void add(std::span<const float> intensity);
    /// The 99 % quantile of the intensities above 0, to 3 %; 1 when there are none.
    double white() const;

  private:
    std::vector<std::uint64_t> counts_;  ///< histogram over the leading bits of the intensity
};

/// The shown amplitude of an intensity, which is power: sqrt(intensity / white), at most 1.
float shade(float intensity, float white);

/// Converts intensities to 16-bit grey values: round(65535 intensity / full_scale), white above
/// full_scale.
std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale);

}  // namespace sonarsim
