#include "calibrate/least_squares.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace sonarsim {

namespace {

/// What Eigen calls a functor.
struct Residuals {
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>* at;
    int parameters, count;

    int inputs() const { return parameters; }
    int values() const { return count; }
    int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
        out = (*at)(x);
        return 0;
    }
};

}  // namespace

Eigen::VectorXd least_squares_fit(
    const Eigen::VectorXd& start, int residuals,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals_at) {
    constexpr double step = 1e-8;  // squared: a ten-thousandth of each parameter
    const Residuals functor{&residuals_at, static_cast<int>(start.size()), residuals};
    Eigen::NumericalDiff<Residuals, Eigen::Central> differentiated(functor, step);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals, Eigen::Central>> method(
        differentiated);
    method.parameters.maxfev = 400;
    Eigen::VectorXd x = start;
    method.minimize(x);
    return x;
}

}  // namespace sonarsim
