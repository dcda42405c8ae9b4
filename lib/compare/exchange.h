#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "compare/measured.h"

namespace sonarsim {

/// A figure of two recordings with the same places, and the standard error of its difference.
struct ExchangedFigure {
    const Measured* real = nullptr;
    const Measured* simulated = nullptr;
    double error = 0.0;
};

/// For each figure the probability, if both recordings come from one distribution, that the
/// greatest standardised difference is as great as its own (Westfall and Young 1993, step-down:
/// among the figures that do not differ more). Then the two values of a place are exchangeable:
/// each draw exchanges every place, in all figures alike, or leaves it. So the significance level
/// holds for all figures together, whatever their distributions and however they depend on each
/// other, as long as places are independent.
std::vector<double> exchange_p(const std::vector<ExchangedFigure>& figures, std::uint32_t seed);

}  // namespace sonarsim
