#include "calibrate/bootstrap.h"

#include <cmath>

#include "core/resampling.h"

namespace sonarsim {

void widen(Bounded& m, double by) {
    const double half = m.half_width();
    const double wider = std::sqrt(half * half + by * by) - half;
    m.low -= wider;
    m.high += wider;
}

std::vector<Bounded> bootstrap_all(
    int count, const std::function<std::vector<double>(const std::vector<double>&)>& estimate,
    const std::vector<double>& least, int draws) {
    const std::vector<double> whole =
        estimate(std::vector<double>(static_cast<std::size_t>(count), 1.0));
    const std::vector<double> variances =
        drawn_variances(whole, count > 1 ? draws : 0, [&](std::uint32_t draw) {
            const PhiloxKey key = stream_key(1, draw, 0, stream_named("calibrate bootstrap"));
            return estimate(drawn_counts(count, key));
        });
    std::vector<Bounded> out;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        const double half = std::sqrt(1.96 * 1.96 * variances[k] + least[k] * least[k]);
        out.push_back({whole[k], whole[k] - half, whole[k] + half});
    }
    return out;
}

Bounded bootstrap(int count, const std::function<double(const std::vector<double>&)>& estimate,
                  double least, int draws) {
    const auto one = [&](const std::vector<double>& weights) {
        return std::vector<double>{estimate(weights)};
    };
    return bootstrap_all(count, one, {least}, draws).front();
}

}  // namespace sonarsim
