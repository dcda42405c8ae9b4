#pragma once

#include <span>

namespace sonarsim {

// Distances of two histograms of one length. Each is taken as shares of its sum.

/// The Jensen-Shannon divergence, bits: 0 for equal shares, 1 for those that share no bin.
double jensen_shannon(std::span<const double> one, std::span<const double> other);

/// The Kullback-Leibler divergence of `one` from `other`, nats, with half a count added to each bin
/// of both, so that an empty bin does not make it infinite.
double kullback_leibler(std::span<const double> one, std::span<const double> other);

/// The earth mover's distance: the mean number of bins by which counts have to be moved.
double earth_movers(std::span<const double> one, std::span<const double> other);

}  // namespace sonarsim
