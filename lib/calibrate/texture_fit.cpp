#include "calibrate/texture_fit.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_echo_patches = 24;
constexpr double errors_off_zero = 3.3;
constexpr int edges = 24;
// A texture that leaves more than this of a correlation unexplained is rejected.
constexpr double most_left = 0.05;
constexpr double half_patch = 12.0;  // bins

using Lags = std::array<double, patch_lags>;

/// A texture and a pulse, with their squared error.
struct TriedTexture {
    double share = 0.0, edge_m = 0.0, bins = 0.0, error = 1e300;
};

/// Sums for a least-squares fit of r - r0 = share (T - r0), with r0 the speckle's correlation and T
/// that of the squares.
struct TextureSums {
    double tt = 0.0, ty = 0.0, yy = 0.0;

    void add(const Lags& seen, const Lags& of_speckle, double step_m, double edge_m) {
        for (std::size_t lag = 0; lag < patch_lags; ++lag) {
            if (!std::isfinite(seen[lag])) continue;
            const double squares =
                std::max(1.0 - static_cast<double>(lag + 1) * step_m / edge_m, 0.0);
            const double t = squares - of_speckle[lag];
            const double y = seen[lag] - of_speckle[lag];
            tt += t * t;
            ty += t * y;
            yy += y * y;
        }
    }
    TriedTexture best() const {
        TriedTexture out;
        out.share = std::max(ty / tt, 0.0);
        out.error = yy - out.share * ty;
        return out;
    }
};

}  // namespace

double BottomTexture::correlation(double of_speckle, double distance_m) const {
    return (1.0 - share) * of_speckle + share * std::max(1.0 - distance_m / edge_m, 0.0);
}

double trigamma(double x) {
    // trigamma(x) = 1 / x^2 + trigamma(x + 1), and its asymptotic series (Abramowitz and Stegun
    // 6.4.12).
    double sum = 0.0;
    while (x < 8.0) {
        sum += 1.0 / (x * x);
        x += 1.0;
    }
    const double y = 1.0 / (x * x);
    return sum + 1.0 / x + 0.5 * y + y / x * (1.0 / 6.0 - y * (1.0 / 30.0 - y / 42.0));
}

double inverse_trigamma(double variance) {
    double low = -7.0, high = 7.0;  // ln x; trigamma falls
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (trigamma(exponential(middle)) > variance ? low : high) = middle;
    }
    return exponential(low);
}

BottomTexture texture_of(const SpeckleConfig& speckle, const LogStatistics& statistics) {
    if (speckle.clutter_shape <= 0.0) return {};
    const double own = trigamma(speckle.clutter_shape);
    return {own / (own + statistics.variance), speckle.clutter_m};
}

EchoPatches echo_patches(const PatchClasses& classes, const Recording& recording,
                         const Lags& of_beams) {
    EchoPatches out{&classes, recording.range_step_m, 0.0, of_beams};
    const double middle = 0.5 * speckle_grid(recording.pings.front()).size.ranges;
    double range = 0.0, stretch = 0.0;
    for (const std::size_t k : classes.echoes) {
        const double at =
            range_of_row(recording, classes.patches[k].row) + middle * recording.range_step_m;
        const double down = recording.altitude_m.value_or(0.0) / at;
        range += at / static_cast<double>(classes.echoes.size());
        // A flat bottom at this altitude is longer than the slant range by 1 / cos of the grazing
        // angle; straight below no length of the ground belongs to a bin.
        stretch += 1.0 / std::sqrt(std::max(1.0 - down * down, 0.1)) /
                   static_cast<double>(classes.echoes.size());
    }
    if (!classes.echoes.empty()) out.range_step_m *= stretch;
    const std::vector<double> sines = beam_sines(recording);
    if (sines.size() > 1)
        out.beam_step_m =
            range * std::fabs(sines.back() - sines.front()) / static_cast<double>(sines.size() - 1);
    return out;
}

std::optional<TextureFit> fit_texture(const EchoPatches& echoes, const PulseModel& model) {
    const PatchClasses& classes = *echoes.classes;
    if (classes.echoes.size() < least_echo_patches) return {};
    const PulseTable pulses = pulse_table(model);
    const bool has_beams = echoes.beam_step_m > 0.0;
    // The variance is that of values half a patch apart, which larger squares would share.
    const double least_m = echoes.range_step_m;
    const double most_m = half_patch * echoes.range_step_m;
    const double count = has_beams ? 2.0 * patch_lags : 1.0 * patch_lags;
    const auto estimate = [&](const std::vector<double>& weights) {
        const Correlations seen = correlations_of(classes.patches, classes.echoes, weights);
        TriedTexture best;
        for (int e = 0; e < edges; ++e) {
            const double edge_m = least_m + (most_m - least_m) * e / (edges - 1);
            TextureSums of_beams;
            if (has_beams)
                of_beams.add(seen.along_beams, echoes.of_beams, echoes.beam_step_m, edge_m);
            for (std::size_t k = 0; k < pulses.rows.size(); ++k) {
                TextureSums sums = of_beams;
                sums.add(seen.along_range, pulses.rows[k], echoes.range_step_m, edge_m);
                TriedTexture tried = sums.best();
                if (tried.error >= best.error) continue;
                best = tried;
                best.edge_m = edge_m;
                best.bins = pulses.bins[k];
            }
        }
        return std::vector<double>{best.share, best.edge_m, best.bins,
                                   std::sqrt(best.error / count)};
    };
    constexpr double bin = 0.05;  // the table's step
    const std::vector<Bounded> found =
        bootstrap_all(classes.places, estimate, {0.0, (most_m - least_m) / (edges - 1), bin, 0.0});
    const Bounded& share = found[0];
    if (share.value < errors_off_zero * share.half_width() / 1.96 || found[3].value > most_left)
        return {};
    return TextureFit{share, found[1], found[2]};
}

}  // namespace sonarsim
