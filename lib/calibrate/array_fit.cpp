#include "calibrate/array_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

using LagVector = Eigen::Matrix<double, patch_lags, 1>;

constexpr double most_taper_interval_db = 8.0;
constexpr double least_taper_db = -41.0;
constexpr double no_taper_db = -13.3;
constexpr double taper_step_db = 0.5;
constexpr int least_units = 24;
// Lengths of the aperture in wavelengths, by factors of 5 % and then 0.4 % up to a factor of 1.8.
constexpr double least_wavelengths = 0.5;
constexpr double most_wavelengths = 5000.0;
constexpr double coarse_step = 0.05;
constexpr double fine_step = 0.004;
constexpr double fine_reach = 0.6;
// The error of a correlation by the model's interpolation between the columns of its grid: the root
// mean square over eight drawn arrays.
constexpr double model_error = 0.002;
// Chi^2 of one degree of freedom stays below it in 95 of 100 cases.
constexpr double chi2_95 = 3.84;
constexpr std::ptrdiff_t most_pairs = 16;

/// The correlation of log powers over t = u L / lambda, of one taper, as a table.
struct TaperedCorrelation {
    static constexpr double step = 0.02;
    static constexpr int steps = 800;
    double side_lobe_db = 0.0;
    double half_power = 0.0;  ///< t at which the power is halved
    std::vector<double> table;

    TaperedCorrelation(double db, const std::vector<double>& of_square) : side_lobe_db(db) {
        constexpr double width = 1e-3;
        LineArray array = line_array(width, db);
        half_power = array.wavelengths * sincos(0.5 * width).sin;
        array.wavelengths = 1.0;
        for (int k = 0; k <= steps; ++k) {
            const double place =
                beam_correlation(array, k * step) * static_cast<double>(of_square.size() - 1);
            const auto at = std::min(static_cast<std::size_t>(place), of_square.size() - 2);
            const double part = place - static_cast<double>(at);
            table.push_back((1.0 - part) * of_square[at] + part * of_square[at + 1]);
        }
    }
    double at(double t) const {
        const double place = std::fabs(t) / step;
        const auto k = static_cast<std::size_t>(place);
        if (k + 1 >= table.size()) return 0.0;
        const double part = place - static_cast<double>(k);
        return (1.0 - part) * table[k] + part * table[k + 1];
    }
    double width_deg(double wavelengths) const {
        return degrees(2.0 * arcsin(std::min(half_power / wavelengths, 1.0)));
    }
};

std::vector<double> log_correlations_of_squares(const LogStatistics& statistics) {
    std::vector<double> out;
    for (int k = 0; k <= 256; ++k)
        out.push_back(statistics.correlation(k / 256.0));
    return out;
}

/// The differences of sines of beams 1 to patch_lags apart, evenly over the fan.
std::array<std::vector<double>, patch_lags> differences_of(const std::vector<double>& sines) {
    std::array<std::vector<double>, patch_lags> out;
    const auto beams = static_cast<std::ptrdiff_t>(sines.size());
    const std::ptrdiff_t step = std::max<std::ptrdiff_t>(beams / most_pairs, 1);
    for (std::ptrdiff_t lag = 1; lag <= patch_lags; ++lag) {
        for (std::ptrdiff_t j = 0; j + lag < beams; j += step)
            out[static_cast<std::size_t>(lag - 1)].push_back(
                sines[static_cast<std::size_t>(j + lag)] - sines[static_cast<std::size_t>(j)]);
    }
    return out;
}

LagVector predicted(const TaperedCorrelation& taper, double wavelengths,
                    const std::array<std::vector<double>, patch_lags>& differences) {
    LagVector out = LagVector::Zero();
    for (int lag = 0; lag < patch_lags; ++lag) {
        const std::vector<double>& of_lag = differences[static_cast<std::size_t>(lag)];
        for (const double u : of_lag)
            out[lag] += taper.at(u * wavelengths) / static_cast<double>(of_lag.size());
    }
    return out;
}

/// An array with its chi^2.
struct TriedArray {
    double side_lobe_db = 0.0, width_deg = 0.0, log_length = 0.0, chi2 = 1e300;
};

Bounded bounded(double value, const std::vector<TriedArray>& near, double TriedArray::*number) {
    Bounded out{value, value, value};
    for (const TriedArray& array : near) {
        out.low = std::min(out.low, array.*number);
        out.high = std::max(out.high, array.*number);
    }
    return out;
}

}  // namespace

double beam_correlation(const LineArray& array, double u) {
    // w = a + b cos(2 pi x), so w^2 = a^2 + b^2 / 2 + 2 a b cos(2 pi x) + b^2 / 2 cos(4 pi x).
    const double a = 0.5 * (1.0 + array.pedestal);
    const double b = 0.5 * (1.0 - array.pedestal);
    const double t = u * array.wavelengths;
    const double even = a * a + 0.5 * b * b;
    const double sum = even * sinc(t) + a * b * (sinc(t + 1.0) + sinc(t - 1.0)) +
                       0.25 * b * b * (sinc(t + 2.0) + sinc(t - 2.0));
    return sum * sum / (even * even);
}

std::array<double, patch_lags> predicted_beam_correlations(const LineArray& array,
                                                           const std::vector<double>& sines,
                                                           const LogStatistics& statistics) {
    std::array<double, patch_lags> out{};
    const auto differences = differences_of(sines);
    for (std::size_t lag = 0; lag < patch_lags; ++lag) {
        for (const double u : differences[lag])
            out[lag] += statistics.correlation(beam_correlation(array, u)) /
                        static_cast<double>(differences[lag].size());
    }
    return out;
}

std::optional<ArrayFit> fit_array(const BeamCorrelations& seen, const std::vector<double>& sines,
                                  const LogStatistics& statistics) {
    if (seen.units < least_units) return {};
    const std::vector<double> of_square = log_correlations_of_squares(statistics);
    std::vector<TaperedCorrelation> tapers;
    for (int k = 0; no_taper_db - k * taper_step_db >= least_taper_db; ++k)
        tapers.emplace_back(no_taper_db - k * taper_step_db, of_square);
    const auto differences = differences_of(sines);
    Eigen::Matrix<double, patch_lags, patch_lags> covariance = seen.covariance;
    covariance.diagonal().array() += model_error * model_error;
    // The inverse of a covariance from n units is (n - 1) / (n - p - 2) too large (Hartlap 2007).
    const double shrunk = (seen.units - patch_lags - 2.0) / (seen.units - 1.0);
    const Eigen::LDLT<Eigen::Matrix<double, patch_lags, patch_lags>> inverse(covariance);
    const auto tried = [&](const TaperedCorrelation& taper, double log_length) {
        const double wavelengths = exponential(log_length);
        const LagVector off = seen.mean - predicted(taper, wavelengths, differences);
        return TriedArray{taper.side_lobe_db, taper.width_deg(wavelengths), log_length,
                          shrunk * off.dot(inverse.solve(off))};
    };
    const auto each = [&](double from, double to, double step, const auto& visit) {
        const int steps = static_cast<int>((to - from) / step);
        for (const TaperedCorrelation& taper : tapers) {
            for (int k = 0; k <= steps; ++k)
                visit(tried(taper, from + k * step));
        }
    };
    TriedArray best;
    const auto keep_best = [&](const TriedArray& array) {
        if (array.chi2 < best.chi2) best = array;
    };
    each(logarithm(least_wavelengths), logarithm(most_wavelengths), coarse_step, keep_best);
    std::vector<TriedArray> near;
    const double middle = best.log_length;
    each(middle - fine_reach, middle + fine_reach, fine_step, [&](const TriedArray& array) {
        keep_best(array);
        near.push_back(array);
    });
    std::erase_if(near, [&](const TriedArray& array) { return array.chi2 > best.chi2 + chi2_95; });
    ArrayFit out;
    out.width_deg = bounded(best.width_deg, near, &TriedArray::width_deg);
    out.side_lobe_db = bounded(best.side_lobe_db, near, &TriedArray::side_lobe_db);
    out.taper_known = out.side_lobe_db.high - out.side_lobe_db.low < most_taper_interval_db;
    return out;
}

}  // namespace sonarsim
