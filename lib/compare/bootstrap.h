#pragma once

#include <cstdint>

#include "compare/measured.h"

namespace sonarsim {

/// A figure of both recordings with its uncertainty.
struct Estimate {
    double real = 0.0;
    double simulated = 0.0;
    double real_error = 0.0;  ///< standard errors
    double simulated_error = 0.0;
    double difference_error = 0.0;
    double degrees = 0.0;  ///< the difference's degrees of freedom; 0: its error cannot be known
    double p = 1.0;        ///< two-sided p-value of no difference
};

/// True if two recordings have the same places, or the same pings, so that their common part
/// cancels in the difference.
struct Pairing {
    bool locations = false;
    bool pings = false;
};

/// The value of a figure; NaN without cells.
double value_of(const Measured& figure);

/// Estimates a figure by the Bayesian bootstrap (Rubin 1981): draws weights for locations, and
/// again for pings and for cells. The variance is the one over locations, plus the excess of the
/// variance over pings above the one over cells (Cameron, Gelbach and Miller 2011): speckle that
/// stays from ping to ping counts once, and a gain that drifts counts as often as there are pings.
Estimate estimate(const Measured& real, const Measured& simulated, Pairing pairing,
                  std::uint32_t seed);

}  // namespace sonarsim
