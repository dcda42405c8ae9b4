#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/bootstrap.h"
#include "compare/measured.h"
#include "recording/recording.h"

namespace sonarsim {

/// A figure of both recordings and what its difference means.
struct ComparedFigure {
    std::string name;
    Estimate estimate;
    double tolerance = 0.0;  ///< in the figure's unit
    double real_half = 0.0;  ///< half of the 95 % intervals
    double simulated_half = 0.0;
    double difference_half = 0.0;
    double standardised = 0.0;  ///< the difference over its standard error; 0 without one
    double adjusted_p = 1.0;    ///< Holm's, for all figures together
    bool agrees = false;   ///< the difference is within the tolerance or within its 95 % interval
    bool differs = false;  ///< adjusted_p is below 0.05
};

/// Distances of two histograms, and the distance that chance alone causes.
struct ComparedHistogram {
    std::string name;
    std::string unit;  ///< the earth mover's
    double jensen_shannon = 0.0;
    double kullback_leibler = 0.0;
    double earth_movers = 0.0;
    double chance_jensen_shannon = 0.0;  ///< 95 % of draws with places exchanged lie below
};

struct Comparison {
    std::string real;
    std::string simulated;
    std::size_t real_pings = 0;
    std::size_t simulated_pings = 0;
    bool has_one_grid = false;
    bool has_relative_levels = false;  ///< powers are relative to the mean of each recording
    std::vector<ComparedFigure> figures;
    std::vector<ComparedHistogram> histograms;
    std::size_t agreeing = 0;
    std::size_t differing = 0;
    int first_change = -1;    ///< the figure that differs most; -1 if none differs
    Measurement real_levels;  ///< only its levels by range
    Measurement simulated_levels;

    bool is_same() const { return differing == 0; }
    double agreement() const {
        return figures.empty()
                   ? 0.0
                   : static_cast<double>(agreeing) / static_cast<double>(figures.size());
    }
};

/// Compares two recordings figure by figure. InputError when they are of different kinds or have
/// no figure in common. The same input gives the same result on any number of threads.
Comparison compare_recordings(const Recording& real, const Recording& simulated,
                              std::uint32_t seed = 1);

}  // namespace sonarsim
