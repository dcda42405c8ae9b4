#pragma once

#include <Eigen/Core>
#include <functional>

namespace sonarsim {

/// The parameters near `start` with the least sum of squared residuals, by Levenberg and
/// Marquardt's method (Eigen's port of MINPACK) with numerical derivatives.
Eigen::VectorXd least_squares_fit(
    const Eigen::VectorXd& start, int residuals,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals_at);

}  // namespace sonarsim
