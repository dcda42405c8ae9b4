#include "calibrate/bootstrap.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace sonarsim {

void widen(Bounded& m, double by) {
    const double half = m.half_width();
    const double wider = std::sqrt(half * half + by * by) - half;
    m.low -= wider;
    m.high += wider;
}

std::vector<double> drawn_weights(int count, std::uint32_t draw) {
    std::vector<double> weights(static_cast<std::size_t>(count), 0.0);
    const PhiloxKey key = stream_key(1, draw, 0, stream_named("calibrate bootstrap"));
    for (int k = 0; k < count; ++k) {
        const PhiloxBlock block = philox({static_cast<std::uint32_t>(k), 0, 0, 0}, key);
        const double at = unit_double(block.x0, block.x1) * count;
        weights[static_cast<std::size_t>(at)] += 1.0;
    }
    return weights;
}

std::vector<Bounded> bootstrap_all(
    int count, const std::function<std::vector<double>(const std::vector<double>&)>& estimate,
    const std::vector<double>& least, int draws) {
    const std::vector<double> whole =
        estimate(std::vector<double>(static_cast<std::size_t>(count), 1.0));
    std::vector<double> sums(whole.size()), squares(whole.size()), counts(whole.size());
    for (int draw = 0; draw < draws && count > 1; ++draw) {
        const std::vector<double> drawn =
            estimate(drawn_weights(count, static_cast<std::uint32_t>(draw)));
        for (std::size_t k = 0; k < whole.size(); ++k) {
            const double off = drawn[k] - whole[k];
            if (!std::isfinite(off)) continue;
            sums[k] += off;
            squares[k] += off * off;
            counts[k] += 1.0;
        }
    }
    std::vector<Bounded> out;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        const double mean = counts[k] > 0.0 ? sums[k] / counts[k] : 0.0;
        const double variance =
            counts[k] > 1.0 ? std::max(squares[k] / counts[k] - mean * mean, 0.0) : 0.0;
        const double half = std::sqrt(1.96 * 1.96 * variance + least[k] * least[k]);
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
