#include "calibrate/array_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/correlations.h"
#include "calibrate/least_squares.h"
#include "calibrate/log_statistics.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double most_taper_interval_db = 8.0;
constexpr double least_taper_db = -41.0;
constexpr double no_taper_db = -13.3;
// The error that the model's interpolation between the columns of its grid leaves in a width.
constexpr double least_taper_error_db = 2.0;
constexpr double least_width_share = 0.02;

/// The correlation of noise between beams, pairs of one difference of number after the other, as a
/// table over the difference of sines, so that a fit takes no time.
struct LogCorrelationOfSquare {
    std::array<double, 257> table{};

    explicit LogCorrelationOfSquare(int looks) {
        for (std::size_t k = 0; k < table.size(); ++k)
            table[k] = log_power_correlation(static_cast<double>(k) / 256.0, looks);
    }
    double at(double k2) const {
        const double place = std::clamp(k2, 0.0, 1.0) * 256.0;
        const auto k = std::min(static_cast<std::size_t>(place), std::size_t{255});
        const double part = place - static_cast<double>(k);
        return (1.0 - part) * table[k] + part * table[k + 1];
    }
};

std::array<double, patch_lags> predicted(const LineArray& array, const std::vector<double>& sines,
                                         const LogCorrelationOfSquare& of_square) {
    std::array<double, patch_lags> out{};
    const auto beams = static_cast<std::ptrdiff_t>(sines.size());
    const std::ptrdiff_t step = std::max<std::ptrdiff_t>(beams / 32, 1);
    for (int lag = 1; lag <= patch_lags; ++lag) {
        double count = 0.0;
        double sum = 0.0;
        for (std::ptrdiff_t j = 0; j + lag < beams; j += step) {
            const double u =
                sines[static_cast<std::size_t>(j + lag)] - sines[static_cast<std::size_t>(j)];
            sum += of_square.at(beam_correlation(array, u));
            count += 1.0;
        }
        out[static_cast<std::size_t>(lag - 1)] = count > 0.0 ? sum / count : 0.0;
    }
    return out;
}

/// The tapers by their highest side lobe. With them a fit works on pedestals, which need no search.
struct TaperTable {
    static constexpr double step_db = 0.2;
    std::vector<double> side_lobe_db, pedestal;
    std::vector<double> half_power;  ///< u L at which the power is halved

    TaperTable() {
        constexpr double width = 1e-3;
        const auto steps = static_cast<int>((no_taper_db - least_taper_db) / step_db + 1e-9);
        for (int k = 0; k <= steps; ++k) {
            const double db = no_taper_db - k * step_db;
            const LineArray array = line_array(width, db);
            side_lobe_db.push_back(db);
            pedestal.push_back(array.pedestal);
            half_power.push_back(array.wavelengths * sincos(0.5 * width).sin);
        }
    }
    /// A column of the table at a pedestal; pedestals fall along it.
    double at(const std::vector<double>& column, double p) const {
        std::size_t k = 1;
        while (k + 1 < pedestal.size() && pedestal[k] > p)
            ++k;
        const double part = (pedestal[k - 1] - p) / (pedestal[k - 1] - pedestal[k]);
        const double bounded = std::clamp(part, 0.0, 1.0);
        return (1.0 - bounded) * column[k - 1] + bounded * column[k];
    }
    double width_deg(const LineArray& array) const {
        const double u = at(half_power, array.pedestal) / array.wavelengths;
        return degrees(2.0 * arcsin(std::min(u, 1.0)));
    }
};

struct Fitter {
    const std::vector<double>& sines;
    LogCorrelationOfSquare of_square;
    TaperTable tapers;

    /// The parameters of a fit: the logarithm of the length, and a number whose logistic function
    /// lies between the least pedestal and the greatest.
    LineArray array(const Eigen::VectorXd& x) const {
        LineArray out;
        out.wavelengths = exponential(std::clamp(x[0], -2.0, 12.0));
        const double least = tapers.pedestal.back();
        const double share = 1.0 / (1.0 + exponential(std::clamp(-x[1], -12.0, 12.0)));
        out.pedestal = least + (tapers.pedestal.front() - least) * share;
        return out;
    }

    Eigen::VectorXd residuals(const Eigen::VectorXd& x, const Correlations& seen) const {
        const std::array<double, patch_lags> mean = predicted(array(x), sines, of_square);
        Eigen::VectorXd out(patch_lags + 1);
        for (int k = 0; k < patch_lags; ++k) {
            const auto at = static_cast<std::size_t>(k);
            const double found = seen.along_beams[at];
            out[k] = std::isfinite(found) ? mean[at] - found : 0.0;
        }
        // If the taper hardly matters, its parameter stays near 0. Beyond 4 nothing changes any
        // more.
        const double beyond = std::max(std::fabs(x[1]) - 4.0, 0.0);
        out[patch_lags] = 1e-3 * x[1] + (x[1] > 0.0 ? 0.05 : -0.05) * beyond;
        return out;
    }

    /// The best of a grid of lengths and tapers: a start that is near the least error.
    Eigen::VectorXd best_of_grid(const Correlations& seen, double log_length) const {
        Eigen::VectorXd best;
        double least = 1e300;
        for (int k = -15; k <= 15; ++k) {
            const double off = 0.1 * k;
            for (const double taper : {-3.0, -1.0, 0.5, 2.0}) {
                Eigen::VectorXd x(2);
                x << log_length + off, taper;
                const double error = residuals(x, seen).squaredNorm();
                if (error < least) best = x;
                least = std::min(least, error);
            }
        }
        return best;
    }

    Eigen::VectorXd fitted(const Correlations& seen, const Eigen::VectorXd& start) const {
        return least_squares_fit(start, patch_lags + 1,
                                 [&](const Eigen::VectorXd& x) { return residuals(x, seen); });
    }
};

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
                                                           int looks) {
    return predicted(array, sines, LogCorrelationOfSquare(looks));
}

ArrayFit fit_array(const std::vector<PatchMoments>& patches, const std::vector<std::size_t>& chosen,
                   int places, const std::vector<double>& sines, int looks,
                   double start_width_deg) {
    const Fitter fitter{sines, LogCorrelationOfSquare(looks), TaperTable()};
    const LineArray of_start = line_array(radians(start_width_deg), no_taper_db);
    const Correlations all = correlations_of(
        patches, chosen, std::vector<double>(static_cast<std::size_t>(places), 1.0));
    const Eigen::VectorXd start =
        fitter.fitted(all, fitter.best_of_grid(all, logarithm(of_start.wavelengths)));
    const auto estimate = [&](const std::vector<double>& weights) {
        const LineArray array =
            fitter.array(fitter.fitted(correlations_of(patches, chosen, weights), start));
        return std::vector<double>{fitter.tapers.width_deg(array),
                                   fitter.tapers.at(fitter.tapers.side_lobe_db, array.pedestal)};
    };
    ArrayFit out;
    const std::vector<Bounded> found =
        bootstrap_all(places, estimate, {0.0, least_taper_error_db}, 60);
    out.width_deg = found[0];
    out.side_lobe_db = found[1];
    out.taper_known = found[1].high - found[1].low < most_taper_interval_db &&
                      found[1].value > least_taper_db + TaperTable::step_db &&
                      found[1].value < no_taper_db - TaperTable::step_db;
    const double least = least_width_share * out.width_deg.value;
    out.width_deg.low -= least;
    out.width_deg.high += least;
    return out;
}

}  // namespace sonarsim
