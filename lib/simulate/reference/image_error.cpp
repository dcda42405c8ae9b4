#include "simulate/reference/image_error.h"

#include <cmath>
#include <cstddef>

namespace sonarsim {

namespace {

/// a / b, with 0 for 0 / 0 and 1 for other divisions by 0.
double share(double a, double b) {
    if (b > 0.0) return a / b;
    return a > 0.0 ? 1.0 : 0.0;
}

}  // namespace

ImageError image_error(std::span<const float> image, std::span<const float> truth,
                       std::span<const std::uint8_t> scored) {
    double difference = 0.0;
    double truth_sum = 0.0;
    double missed = 0.0;
    double occupied = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        if (!scored.empty() && scored[k] == 0) continue;
        const double a = image[k];
        const double b = truth[k];
        difference += std::fabs(a - b);
        truth_sum += b;
        missed += b > 0.0 && !(a > 0.0);
        occupied += b > 0.0;
    }
    return {share(difference, truth_sum), share(missed, occupied)};
}

}  // namespace sonarsim
