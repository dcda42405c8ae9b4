#include "compare/student.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/log_gamma.h"
#include "core/units.h"

namespace sonarsim {

double student_tails(double t, double degrees) {
    // With t = sqrt(n) tan(a) the density is proportional to cos^(n - 1) a; Simpson's rule.
    const double n = std::min(degrees, 300.0);
    const double angle = arctan2(std::fabs(t), std::sqrt(n));
    const double factor =
        exponential(log_gamma(0.5 * (n + 1.0)) - log_gamma(0.5 * n)) / std::sqrt(pi);
    constexpr int steps = 400;
    const double step = (0.5 * pi - angle) / steps;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double cosine = sincos(angle + k * step).cos;
        const double weight = k == 0 ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
        if (cosine > 1e-300) sum += weight * power(cosine, n - 1.0);
    }
    // At a right angle the density is 0, except for n = 1, where it is 1.
    if (n <= 1.0) sum += 1.0;
    return std::clamp(2.0 * factor * sum * step / 3.0, 0.0, 1.0);
}

double student_95(double degrees) {
    double low = 0.0;
    double high = 1000.0;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        (student_tails(middle, degrees) > 0.05 ? low : high) = middle;
    }
    return low;
}

}  // namespace sonarsim
