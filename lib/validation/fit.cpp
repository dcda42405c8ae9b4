#include "validation/fit.h"

#include <cmath>
#include <limits>

namespace sonarsim {

std::vector<bool> pareto_front(std::span<const double> cost, std::span<const double> error) {
    std::vector<bool> front(cost.size(), true);
    for (std::size_t i = 0; i < cost.size(); ++i) {
        for (std::size_t k = 0; k < cost.size(); ++k) {
            const bool as_good = cost[k] <= cost[i] && error[k] <= error[i];
            if (as_good && (cost[k] < cost[i] || error[k] < error[i])) front[i] = false;
        }
    }
    return front;
}

double fit_exponent(std::span<const double> x, std::span<const double> y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0 && y[i] > 0.0)) return std::numeric_limits<double>::quiet_NaN();
        const double u = std::log(x[i] / x[0]);
        const double v = std::log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    const double spread = n * sxx - sx * sx;
    if (!(spread > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return (n * sxy - sx * sy) / spread;
}

}  // namespace sonarsim
