#include <algorithm>
#include <cmath>

#include "calibrate/log_statistics.h"
#include "calibrate/noise_fit.h"
#include "calibrated/decibel.h"

namespace sonarsim {

namespace {

constexpr double db_of_neper_ahead = 4.342944819032518;

}  // namespace

Bounded common_mode(const Recording& recording, const LawFit& law, const NoiseFit& noise,
                    double width_rad) {
    const std::vector<double>& bearings = recording.bearing_rad;
    if (bearings.empty()) return {-300.0, -300.0, -300.0};
    const auto ahead = std::min_element(bearings.begin(), bearings.end(), [](double a, double b) {
        return std::fabs(a) < std::fabs(b);
    });
    if (std::fabs(*ahead) > 0.5 * width_rad) return {-300.0, -300.0, -300.0};
    const auto beam = static_cast<std::size_t>(ahead - bearings.begin());
    const double full_value = full_value_of(recording);
    const auto excess = [&](const std::vector<double>& weights) {
        double sum = 0.0, count = 0.0;
        for (std::size_t b = 0; b < noise.used.size(); ++b) {
            // An echo that stays is straight ahead as well.
            if (!noise.used[b].alone) continue;
            for (const RecordedPing& ping : recording.pings) {
                for (int i = noise.used[b].row; i < noise.used[b].row + rows_of_noise_block; ++i) {
                    const double value = ping.values[static_cast<std::size_t>(i) *
                                                         static_cast<std::size_t>(ping.beams) +
                                                     beam];
                    sum += weights[b] * (law.log_power(value, full_value) -
                                         noise.at(noise.used[b].range_m) / db_of_neper_ahead -
                                         log_power_mean(law.looks));
                    count += weights[b];
                }
            }
        }
        return db_of_neper_ahead * sum / count;
    };
    const Bounded over = bootstrap(static_cast<int>(noise.used.size()), excess, 0.2);
    // Half as strong as the noise of a beam is 1.8 dB more; less may be anything else.
    if (!(over.low >= 0.5)) return {-300.0, -300.0, -300.0};
    const auto shared = [](double db) { return db_of_power(power_of_db(db) - 1.0); };
    return {shared(over.value), shared(over.low), shared(over.high)};
}

}  // namespace sonarsim
