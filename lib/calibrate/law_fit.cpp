#include "calibrate/law_fit.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_patches = 8;
// Between the laws' slopes of 1 and 0.
constexpr double power_law_slope = 0.5;
// Patches of about one level do not determine the slope.
constexpr double least_spread_of_levels = 0.1;
// The error that a finite patch, its trend and the steps of the values leave in a law.
constexpr double least_error = 0.01;

// If the least powers of noise, a share p, become 0, its logarithm lacks p (0.8 - 2 ln p) of the
// variance pi^2 / 6: half a per cent at this share. A patch must not be chosen by its own zeros,
// since that would truncate the tail, too.
constexpr double most_cut_off = 5e-4;

double log_of_value(double value, double step) {
    return logarithm(std::max(value, 0.5 * step));
}

/// Patches of the values and of their logarithms, and which of them are even speckle.
struct LawPatches {
    std::vector<PatchMoments> values, logs;
    std::vector<std::size_t> even;
    int places = 0;
};

struct WeightedSums {
    double weight = 0.0, variance = 0.0, third = 0.0;
};

WeightedSums sums_of(const std::vector<PatchMoments>& patches, const std::vector<std::size_t>& even,
                     const std::vector<double>& weights) {
    WeightedSums out;
    for (const std::size_t k : even) {
        const double w = weights[static_cast<std::size_t>(patches[k].place)];
        out.weight += w;
        out.variance += w * patches[k].variance;
        out.third += w * patches[k].third;
    }
    out.variance /= out.weight;
    out.third /= out.weight;
    return out;
}

double skewness_of(const std::vector<PatchMoments>& patches, const std::vector<std::size_t>& even,
                   const std::vector<double>& weights) {
    const WeightedSums sums = sums_of(patches, even, weights);
    return sums.third / power(sums.variance, 1.5);
}

/// The slope of log standard deviation of v against the log of its mean.
double slope_of(const LawPatches& patches, const std::vector<double>& weights) {
    double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const std::size_t k : patches.even) {
        const PatchMoments& p = patches.values[k];
        const double weight = weights[static_cast<std::size_t>(p.place)];
        const double level = logarithm(p.mean_value);
        const double spread = 0.5 * logarithm(p.variance);
        w += weight;
        x += weight * level;
        y += weight * spread;
        xx += weight * level * level;
        xy += weight * level * spread;
    }
    return (xy - x * y / w) / (xx - x * x / w);
}

double spread_of_levels(const LawPatches& patches) {
    double sum = 0.0, square = 0.0;
    for (const std::size_t k : patches.even) {
        const double level = logarithm(patches.values[k].mean_value);
        sum += level;
        square += level * level;
    }
    const auto n = static_cast<double>(patches.even.size());
    return std::sqrt(std::max(square / n - sum * sum / (n * n), 0.0));
}

/// The correlation of logarithms a third of a patch apart, along range.
double lasting_correlation(const LawPatches& patches) {
    double structure = 0.0, variance = 0.0;
    for (const std::size_t k : patches.even) {
        structure += patches.logs[k].along_range[patch_lags - 1];
        variance += patches.logs[k].variance;
    }
    return 1.0 - structure / variance;
}

/// InputError if values a third of a patch apart are correlated, or if neither skewness can, within
/// its errors, lie between -2 and -0.3 (or 0.3 above that of the start). One look has -1.14, eight
/// looks have about -0.4.
void check_speckle(const LawPatches& patches, const Bounded& of_logs, const Bounded& of_values,
                   double of_start) {
    const double most = std::max(-0.3, of_start + 0.3);
    const auto speckle = [&](const Bounded& s) { return s.high > -2.0 && s.low < most; };
    const double lasting = lasting_correlation(patches);
    if (lasting > 0.6) {
        throw InputError("values 8 bins apart have the correlation " +
                         std::to_string(lasting).substr(0, 4) +
                         ", speckle of a sonar much less: is this a photograph, a picture that was "
                         "smoothed, or a pulse of many bins?");
    }
    if (speckle(of_logs) || speckle(of_values)) return;
    throw InputError("the logarithms of neighbouring values have a skewness of " +
                     std::to_string(of_logs.value).substr(0, 5) +
                     ", speckle of a sonar has -1.14: is this a photograph, or were the values "
                     "changed after the sonar?");
}

LawPatches law_patches(const std::vector<RecordedPing>& pings, double full_value,
                       const std::vector<bool>& places, double offset) {
    const double step = full_value > 15.0 ? 1.0 : full_value / 65535.0;
    LawPatches out;
    const auto moments = [&](const std::function<double(double, int)>& scaled) {
        return at_places(patch_moments(pings, full_value, scaled), places);
    };
    out.values = moments([](double v, int) { return v; });
    out.logs = moments([&](double v, int) { return log_of_value(v + offset * full_value, step); });
    // Evenness is measured in logarithms, because in these no law makes strong patches uneven.
    out.even = speckle_patches(out.logs, full_value > 15.0 ? 6.0 : 0.0);
    out.places = speckle_grid(pings.front()).places();
    if (out.even.size() < least_patches) {
        throw InputError(
            "fewer than 8 even patches of speckle, of 24 bins and 24 beams (96 bins "
            "of a sonar with few beams), between the ends of the scale: record "
            "longer pings, or with another gain");
    }
    return out;
}

}  // namespace

double LawFit::log_power(double value, double full_value) const {
    if (companding == Companding::log)
        return (value / full_value + offset - 1.0) * dynamic_range_db.value / db_of_e;
    const double step = full_value > 15.0 ? 1.0 : full_value / 65535.0;
    return 2.0 / gamma.value *
           (log_of_value(value + offset * full_value, step) - logarithm(full_value));
}

bool LawFit::cuts_off(double mean_power, double full_value) const {
    const double step = full_value > 15.0 ? 1.0 : full_value / 65535.0;
    return exponential(log_power(0.5 * step, full_value)) > most_cut_off * mean_power;
}

LawFit stated_law(const ReceiverConfig& receiver, const LogStatistics& statistics) {
    LawFit out;
    out.companding = receiver.companding == Companding::log ? Companding::log : Companding::gamma;
    const double gamma = receiver.companding == Companding::linear ? 1.0 : receiver.gamma;
    out.gamma = {gamma, gamma, gamma};
    out.offset = receiver.offset;
    const double range_db = receiver.dynamic_range_db;
    out.dynamic_range_db = {range_db, range_db, range_db};
    out.statistics = statistics;
    return out;
}

double full_value_of(const Recording& recording) {
    if (recording.law.full_value > 0.0) return recording.law.full_value;
    float most = 0.0F;
    for (const RecordedPing& ping : recording.pings) {
        for (const float v : ping.values)
            most = std::max(most, v);
    }
    return most;
}

LawFit fit_law(const std::vector<RecordedPing>& pings, double full_value,
               const LogStatistics& statistics, const std::vector<bool>& places, double offset,
               std::optional<Companding> known) {
    const LawPatches patches = law_patches(pings, full_value, places, offset);
    const std::vector<double> all(static_cast<std::size_t>(patches.places), 1.0);
    const auto skewness = [&](const std::vector<PatchMoments>& of) {
        return bootstrap(patches.places, [&](const std::vector<double>& weights) {
            return skewness_of(of, patches.even, weights);
        });
    };
    const Bounded of_logs = skewness(patches.logs);
    const Bounded of_values = skewness(patches.values);
    check_speckle(patches, of_logs, of_values, statistics.skewness);

    LawFit out;
    out.statistics = statistics;
    out.offset = offset;
    for (const std::size_t k : patches.even)
        out.mean_share += 1.0 / (patches.values[k].mean_value / full_value + offset);
    out.mean_share = static_cast<double>(patches.even.size()) / out.mean_share;
    out.patches = static_cast<int>(patches.even.size());
    out.spread_of_levels = spread_of_levels(patches);
    out.slope = bootstrap(patches.places, [&](const std::vector<double>& weights) {
        return slope_of(patches, weights);
    });
    const double expected = statistics.skewness;
    const bool by_slope = out.spread_of_levels > least_spread_of_levels;
    const bool power_law =
        known      ? *known != Companding::log
        : by_slope ? out.slope.value > power_law_slope
                   : std::fabs(of_logs.value - expected) < std::fabs(of_values.value - expected);
    out.companding = power_law ? Companding::gamma : Companding::log;
    const std::vector<PatchMoments>& used = power_law ? patches.logs : patches.values;
    out.skewness = power_law ? of_logs : of_values;
    const double sigma = std::sqrt(statistics.variance);
    const auto deviation = [&](const std::vector<double>& weights) {
        return std::sqrt(sums_of(used, patches.even, weights).variance);
    };
    if (power_law) {
        const auto gamma = [&](const std::vector<double>& w) { return 2.0 * deviation(w) / sigma; };
        out.gamma = bootstrap(patches.places, gamma, least_error * gamma(all));
    } else {
        const auto range = [&](const std::vector<double>& w) {
            return full_value * db_of_e * sigma / deviation(w);
        };
        out.dynamic_range_db = bootstrap(patches.places, range, least_error * range(all));
    }
    return out;
}

}  // namespace sonarsim
