#pragma once

#include <span>

#include "core/random.h"

namespace sonarsim {

/// The beams that a receiver loses from time to time.
struct Dropouts {
    float share = 0.0F;  ///< lost beams of a ping, 0 to 1
};

/// Sets the lost beams of `image` [range bins, beams] to 0. Each beam is lost with the probability
/// `share`, by a draw of its own. Returns the number of lost beams.
int drop_beams(std::span<float> image, int beams, const Dropouts& dropouts, PhiloxKey key);

}  // namespace sonarsim
