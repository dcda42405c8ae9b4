#include "calibrate/common_mode.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "calibrate/patch_classes.h"
#include "calibrated/decibel.h"
#include "calibrated/line_array.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// Beams stand out if they exceed the others by this many times their spread, and by at least 0.4
// dB.
constexpr double deviations_of_ahead = 4.0;
constexpr double least_over_db = 0.4;
// The beams in a side lobe and the null before it.
constexpr int most_gap = 8;
constexpr Bounded none_seen{-300.0, -300.0, -300.0};

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The level of a beam over the law of the noise, from the blocks without echoes.
double excess_db(const Recording& recording, const LawFit& law, const NoiseFit& noise, int beam,
                 const std::vector<double>& weights) {
    const double full_value = full_value_of(recording);
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < noise.used.size(); ++b) {
        // A constant echo is straight ahead as well.
        if (!noise.used[b].without_echo || weights[b] == 0.0) continue;
        const double level = noise.at(noise.used[b].range_m) / db_of_e;
        for (const RecordedPing& ping : recording.pings) {
            for (int i = noise.used[b].row; i < noise.used[b].row + rows_of_noise_block; ++i) {
                const auto at = static_cast<std::size_t>(i) * static_cast<std::size_t>(ping.beams) +
                                static_cast<std::size_t>(beam);
                sum += weights[b] *
                       (law.log_power(ping.values[at], full_value) - level - law.statistics.mean);
                count += weights[b];
            }
        }
    }
    return db_of_e * sum / count;
}

/// The last beam in one direction before a gap of beams that do not stand out.
int end_of(const std::vector<bool>& stands_out, int from, int step) {
    int last = from;
    for (int j = from; j >= 0 && j < std::ssize(stands_out) && std::abs(j - last) <= most_gap;
         j += step)
        if (stands_out[static_cast<std::size_t>(j)]) last = j;
    return last;
}

/// The power that an array receives at the sine u of a wave from its axis, 1 without errors of
/// phase at 0.
double pattern_power(const LineArray& array, double u) {
    constexpr int steps = 400;
    std::complex<double> sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double x = (k + 0.5) / steps - 0.5;
        const SinCos turn = sincos(2.0 * pi * u * array.wavelengths * x);
        sum += array.weight(x) * std::complex<double>(turn.cos, turn.sin) / (1.0 * steps);
    }
    return std::norm(sum);
}

double pattern_power(const BeamConfig& beam, double width_deg, double u) {
    LineArray array = line_array(radians(width_deg), beam.side_lobe_db);
    array.quadratic_rad = beam.aberration_rad[0];
    array.cubic_rad = beam.aberration_rad[1];
    array.quartic_rad = beam.aberration_rad[2];
    return pattern_power(array, u);
}

std::size_t beam_ahead(const std::vector<double>& sines) {
    const auto least = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
    return static_cast<std::size_t>(std::min_element(sines.begin(), sines.end(), least) -
                                    sines.begin());
}

}  // namespace

AheadBeams ahead_beams(const Recording& recording, const LawFit& law, const NoiseFit& noise) {
    const std::vector<double> sines = beam_sines(recording);
    const bool has_noise = std::any_of(noise.used.begin(), noise.used.end(),
                                       [](const NoiseBlock& block) { return block.without_echo; });
    if (sines.size() < 3 || !has_noise) return {};
    const std::vector<double> all(noise.used.size(), 1.0);
    std::vector<double> levels;
    for (int j = 0; j < std::ssize(sines); ++j)
        levels.push_back(excess_db(recording, law, noise, j, all));
    const double middle = median_of(levels);
    std::vector<double> sizes;
    for (const double level : levels)
        sizes.push_back(std::fabs(level - middle));
    const double over = std::max(deviations_of_ahead * 1.48 * median_of(sizes), least_over_db);
    std::vector<bool> stands_out;
    for (const double level : levels)
        stands_out.push_back(level - middle > over);
    const std::size_t ahead = beam_ahead(sines);
    if (!stands_out[ahead]) return {};
    const int from = static_cast<int>(ahead);
    return {end_of(stands_out, from, -1), end_of(stands_out, from, 1) + 1};
}

Bounded common_mode(const Recording& recording, const LawFit& law, const NoiseFit& noise,
                    const BeamConfig& beam, const Bounded& width_deg) {
    if (noise.ahead.end == 0) return none_seen;
    const std::vector<double> sines = beam_sines(recording);
    const std::size_t ahead = beam_ahead(sines);
    const auto of_blocks = [&](const std::vector<double>& weights) {
        return excess_db(recording, law, noise, static_cast<int>(ahead), weights);
    };
    Bounded over = bootstrap(static_cast<int>(noise.used.size()), of_blocks, 0.2);
    // An error of the law scales all levels.
    const Bounded& scale = law.companding == Companding::log ? law.dynamic_range_db : law.gamma;
    widen(over, over.value * scale.half_width() / scale.value);
    // Common noise of half the noise of a beam adds 1.8 dB; a smaller excess may have other causes.
    if (!(over.low >= 0.5)) return none_seen;
    const auto shared = [&](double over_db, double width) {
        return db_of_power(power_of_db(over_db) - 1.0) -
               db_of_power(pattern_power(beam, width, sines[ahead]));
    };
    // A narrower beam receives less of this noise off its axis.
    return {shared(over.value, width_deg.value), shared(over.low, width_deg.high),
            shared(over.high, width_deg.low)};
}

}  // namespace sonarsim
