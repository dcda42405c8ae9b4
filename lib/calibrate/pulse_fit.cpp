#include "calibrate/pulse_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/correlations.h"
#include "calibrated/range_response.h"

namespace sonarsim {

namespace {

constexpr double least_correlation = 0.04;
constexpr double shortest_bins = 0.6;
constexpr double longest_bins = 8.0;
constexpr int table_steps = 149;    // steps of 0.05 bins
constexpr int steps_of_drawn = 75;  // steps of 0.1 bins
// The error that taps of whole bins leave in a pulse, as a share of its width.
constexpr double least_half_width = 0.01;
// The draws for several samples have an error of 0.005 in a correlation, which changes by 0.25 for
// a bin of width.
constexpr double least_half_width_of_drawn = 0.025;

using Lags = std::array<double, patch_lags>;

double squared_error(const Lags& a, const Lags& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (std::isfinite(b[k])) sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sum;
}

/// The width with the least error, interpolated between rows of the table by a parabola.
double best_bins(const PulseTable& table, const Lags& seen) {
    std::vector<double> errors;
    errors.reserve(table.rows.size());
    for (const Lags& row : table.rows)
        errors.push_back(squared_error(row, seen));
    const auto at =
        static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
    double part = 0.0;
    if (at > 0 && at + 1 < errors.size()) {
        const double bend = errors[at - 1] - 2.0 * errors[at] + errors[at + 1];
        if (bend > 0.0) part = 0.5 * (errors[at - 1] - errors[at + 1]) / bend;
    }
    return table.bins[at] + part * (table.bins[1] - table.bins[0]);
}

}  // namespace

ReceivedKind echo_kind(const SpeckleConfig& speckle) {
    return speckle.mode == SpeckleMode::scene ? ReceivedKind::echo : ReceivedKind::echo_of_bins;
}

PulseModel pulse_model(const InstrumentConfig& instrument, ReceivedKind kind) {
    return {instrument.receiver, instrument.pulse.side_lobe_db, kind};
}

double pulse_bins_of(const PulseConfig& pulse, double range_step_m) {
    return pulse.resolution_m > 0.0 ? pulse.resolution_m / range_step_m : 1.0;
}

std::vector<double> PulseModel::taps(double resolution_bins) const {
    const double in_samples = resolution_bins * std::max(receiver.samples, 1);
    const std::vector<float> of_pulse = kind == ReceivedKind::noise
                                            ? noise_taps(in_samples, side_lobe_db)
                                            : range_taps(in_samples, side_lobe_db, false).taps;
    std::vector<double> out(of_pulse.begin(), of_pulse.end());
    if (kind != ReceivedKind::echo) return out;
    // An echo is first shared between two samples in proportion to its closeness. On average the
    // products of its shares are 1/6, 2/3, 1/6, as for two fixed shares with the sum 1 and the
    // product 1/6.
    const double a = 0.5 + 0.5 / std::sqrt(3.0);
    out.push_back(0.0);
    for (std::size_t k = out.size() - 1; k > 0; --k)
        out[k] = a * out[k] + (1.0 - a) * out[k - 1];
    out[0] *= a;
    return out;
}

LogStatistics PulseModel::statistics(double resolution_bins) const {
    return sampled_statistics(receiver, taps(resolution_bins));
}

std::array<double, patch_lags> PulseModel::correlations(double resolution_bins) const {
    return sampled_range_correlations(receiver, taps(resolution_bins));
}

PulseTable pulse_table(const PulseModel& model) {
    PulseTable out;
    // Drawn rows take longer, so their steps are coarser.
    const int steps = model.receiver.samples > 1 ? steps_of_drawn : table_steps;
    for (int k = 0; k < steps; ++k) {
        out.bins.push_back(shortest_bins + (longest_bins - shortest_bins) * k / (steps - 1));
        out.rows.push_back(model.correlations(out.bins.back()));
    }
    return out;
}

std::optional<Bounded> fit_pulse(const std::vector<PatchMoments>& patches,
                                 const std::vector<std::size_t>& chosen, int places,
                                 const PulseModel& model) {
    const std::vector<double> all(static_cast<std::size_t>(places), 1.0);
    if (correlations_of(patches, chosen, all).along_range[0] < least_correlation) return {};
    const PulseTable table = pulse_table(model);
    const auto bins = [&](const std::vector<double>& weights) {
        return best_bins(table, correlations_of(patches, chosen, weights).along_range);
    };
    const double least = model.receiver.samples > 1 ? least_half_width_of_drawn : least_half_width;
    return bootstrap(places, bins, least * bins(all));
}

}  // namespace sonarsim
