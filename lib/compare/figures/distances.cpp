#include "compare/figures/distances.h"

#include <cmath>
#include <numeric>

#include "core/elementary.h"

namespace sonarsim {

namespace {

double sum_of(std::span<const double> histogram) {
    return std::accumulate(histogram.begin(), histogram.end(), 0.0);
}

/// p ln(p / q), 0 for p = 0.
double term(double p, double q) {
    return p > 0.0 ? p * logarithm(p / q) : 0.0;
}

}  // namespace

double jensen_shannon(std::span<const double> one, std::span<const double> other) {
    constexpr double ln_2 = 0x1.62e42fefa39efp-1;
    const double all_one = sum_of(one);
    const double all_other = sum_of(other);
    double sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double p = one[i] / all_one;
        const double q = other[i] / all_other;
        const double middle = 0.5 * (p + q);
        sum += 0.5 * (term(p, middle) + term(q, middle));
    }
    return sum / ln_2;
}

double kullback_leibler(std::span<const double> one, std::span<const double> other) {
    const double more = 0.5 * static_cast<double>(one.size());
    const double all_one = sum_of(one) + more;
    const double all_other = sum_of(other) + more;
    double sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
        sum += term((one[i] + 0.5) / all_one, (other[i] + 0.5) / all_other);
    return sum;
}

double earth_movers(std::span<const double> one, std::span<const double> other) {
    const double all_one = sum_of(one);
    const double all_other = sum_of(other);
    double moved = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        moved += one[i] / all_one - other[i] / all_other;
        sum += std::fabs(moved);
    }
    return sum;
}

}  // namespace sonarsim
