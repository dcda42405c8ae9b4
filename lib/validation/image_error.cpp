#include "validation/image_error.h"

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

ImageError image_error(std::span<const float> image, std::span<const float> truth) {
    double difference = 0.0;
    double square = 0.0;
    double truth_sum = 0.0;
    double truth_square = 0.0;
    double missed = 0.0;
    double invented = 0.0;
    double image_bins = 0.0;
    double truth_bins = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const double a = image[k];
        const double b = truth[k];
        difference += std::fabs(a - b);
        square += (a - b) * (a - b);
        truth_sum += b;
        truth_square += b * b;
        image_bins += a > 0.0;
        truth_bins += b > 0.0;
        missed += b > 0.0 && !(a > 0.0);
        invented += a > 0.0 && !(b > 0.0);
    }
    return {share(difference, truth_sum), std::sqrt(share(square, truth_square)),
            share(missed, truth_bins), share(invented, image_bins)};
}

}  // namespace sonarsim
