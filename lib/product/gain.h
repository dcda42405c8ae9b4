#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// Finds how bright a picture for the eye should be, from all of its intensities.
class Gain {
  public:
    Gain();
    void add(std::span<const float> intensity);
    /// The intensity that one in a hundred of those above 0 exceeds, to 3 %; 1 when there are none.
    double white() const;

  private:
    std::vector<std::uint64_t> counts_;  ///< by the leading bits of the number
};

/// Intensity is power, a display shows amplitude: sqrt(intensity / white), at most 1.
float shade(float intensity, float white);

}  // namespace sonarsim
