#pragma once

#include <span>
#include <vector>

namespace sonarsim {

/// Marks the points (cost, error) that no other point dominates: none is as good in both and better
/// in one.
std::vector<bool> pareto_front(std::span<const double> cost, std::span<const double> error);

/// The exponent b of y = a x^b, from least squares of log y on log x. NaN for fewer than two
/// different x, or if a value is not positive.
double fit_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace sonarsim
