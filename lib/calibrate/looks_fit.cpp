#include "calibrate/looks_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/log_statistics.h"
#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_patches_of_looks = 24;
constexpr int most_looks = 8;
// Values of a few steps cut the tail of the logarithm off.
constexpr double least_mean_value = 20.0;
// Patches are finite and their law has an error.
constexpr double least_skewness_error = 0.03;
constexpr double errors_of_95 = 1.96;
constexpr double errors_to_leave_start = 3.3;

double errors_off(const Bounded& skewness, int looks) {
    const double error = skewness.half_width() / errors_of_95;
    return std::fabs(log_power_skewness(looks) - skewness.value) / std::max(error, 1e-9);
}

}  // namespace

Bounded skewness_of_noise(const PatchClasses& classes, const LawFit& law) {
    std::vector<std::size_t> fine;
    for (const std::size_t k : classes.noise) {
        const PatchMoments& p = classes.patches[k];
        if (p.mean_value >= least_mean_value) fine.push_back(k);
    }
    if (fine.size() < least_patches_of_looks) return law.skewness;
    struct Sums {
        double count = 0.0, mean = 0.0, square = 0.0, cube = 0.0;
    };
    std::vector<Sums> places(static_cast<std::size_t>(classes.places));
    for (const std::size_t k : fine) {
        const PatchMoments& p = classes.patches[k];
        Sums& sums = places[static_cast<std::size_t>(p.place)];
        sums.count += 1.0;
        sums.mean += p.mean;
        sums.square += p.square;
        sums.cube += p.cube;
    }
    const auto skewness = [&](const std::vector<double>& weights) {
        double second = 0.0, third = 0.0, weight = 0.0;
        for (std::size_t place = 0; place < places.size(); ++place) {
            const Sums& s = places[place];
            if (s.count == 0.0) continue;
            const double mean = s.mean / s.count;
            const double w = weights[place] * s.count;
            weight += w;
            second += w * (s.square / s.count - mean * mean);
            third +=
                w * (s.cube / s.count - 3.0 * mean * s.square / s.count + 2.0 * mean * mean * mean);
        }
        return third / weight / power(second / weight, 1.5);
    };
    return bootstrap(classes.places, skewness, least_skewness_error);
}

int fit_looks(const Bounded& skewness, int start, std::vector<std::string>& notes) {
    if (errors_off(skewness, start) < errors_to_leave_start) return start;
    int best = start;
    for (int n = 1; n <= most_looks; ++n) {
        if (errors_off(skewness, n) < errors_off(skewness, best)) best = n;
    }
    if (errors_off(skewness, best) < errors_to_leave_start) return best;
    notes.emplace_back(
        "receiver.looks: the skewness of log powers fits no number of looks; that of the start is "
        "kept");
    return start;
}

}  // namespace sonarsim
