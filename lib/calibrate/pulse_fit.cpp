#include "calibrate/pulse_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/correlations.h"
#include "calibrate/log_statistics.h"
#include "calibrated/range_response.h"

namespace sonarsim {

namespace {

constexpr double least_correlation = 0.04;
constexpr double shortest_bins = 0.6;
constexpr double longest_bins = 8.0;
constexpr int table_steps = 149;  // steps of 0.05 bins
// The error that taps of whole bins leave in a pulse, as a share of it.
constexpr double least_half_width = 0.01;

double product(const std::vector<float>& taps, int lag) {
    const auto from = static_cast<std::size_t>(std::abs(lag));
    double sum = 0.0;
    for (std::size_t k = 0; k + from < taps.size(); ++k)
        sum += static_cast<double>(taps[k]) * taps[k + from];
    return sum;
}

/// The complex correlation of bins so far apart. An echo is first shared between two bins in
/// proportion to its closeness: its taps' products are weighted 1/6, 2/3, 1/6.
double amplitude_correlation(const std::vector<float>& taps, int lag, ReceivedKind kind) {
    if (kind != ReceivedKind::echo) return product(taps, lag) / product(taps, 0);
    const auto shared = [&](int at) {
        return (product(taps, at - 1) + 4.0 * product(taps, at) + product(taps, at + 1)) / 6.0;
    };
    return shared(lag) / shared(0);
}

using Lags = std::array<double, patch_lags>;

/// The predictions for pulses of all widths, one after the other.
std::vector<Lags> prediction_table(double side_lobe_db, ReceivedKind kind, int looks) {
    std::vector<Lags> out;
    for (int k = 0; k < table_steps; ++k) {
        const double bins = shortest_bins + (longest_bins - shortest_bins) * k / (table_steps - 1);
        out.push_back(predicted_range_correlations(bins, side_lobe_db, kind, looks));
    }
    return out;
}

double squared_error(const Lags& a, const Lags& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (std::isfinite(b[k])) sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sum;
}

/// The place of the least error, between two rows of the table by a parabola.
double best_bins(const std::vector<Lags>& table, const Lags& seen) {
    std::vector<double> errors;
    errors.reserve(table.size());
    for (const Lags& row : table)
        errors.push_back(squared_error(row, seen));
    const auto at =
        static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
    double part = 0.0;
    if (at > 0 && at + 1 < errors.size()) {
        const double bend = errors[at - 1] - 2.0 * errors[at] + errors[at + 1];
        if (bend > 0.0) part = 0.5 * (errors[at - 1] - errors[at + 1]) / bend;
    }
    const double step = (longest_bins - shortest_bins) / (table_steps - 1);
    return shortest_bins + step * (static_cast<double>(at) + part);
}

}  // namespace

ReceivedKind echo_kind(const SpeckleConfig& speckle) {
    return speckle.mode == SpeckleMode::scene ? ReceivedKind::echo : ReceivedKind::echo_of_bins;
}

std::array<double, patch_lags> predicted_range_correlations(double resolution_bins,
                                                            double side_lobe_db, ReceivedKind kind,
                                                            int looks) {
    const std::vector<float> taps = kind == ReceivedKind::noise
                                        ? noise_taps(resolution_bins, side_lobe_db)
                                        : range_taps(resolution_bins, side_lobe_db, false).taps;
    Lags out{};
    for (int lag = 1; lag <= patch_lags; ++lag) {
        const double k = amplitude_correlation(taps, lag, kind);
        out[static_cast<std::size_t>(lag - 1)] = log_power_correlation(k * k, looks);
    }
    return out;
}

std::optional<Bounded> fit_pulse(const std::vector<PatchMoments>& patches,
                                 const std::vector<std::size_t>& chosen, int places,
                                 double side_lobe_db, ReceivedKind kind, int looks) {
    const std::vector<double> all(static_cast<std::size_t>(places), 1.0);
    if (correlations_of(patches, chosen, all).along_range[0] < least_correlation) return {};
    const std::vector<Lags> table = prediction_table(side_lobe_db, kind, looks);
    const auto bins = [&](const std::vector<double>& weights) {
        return best_bins(table, correlations_of(patches, chosen, weights).along_range);
    };
    return bootstrap(places, bins, least_half_width * bins(all));
}

}  // namespace sonarsim
