#include "calibrate/soundings_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "calibrate/least_squares.h"
#include "calibrated/decibel.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/units.h"
#include "recording/law.h"

namespace sonarsim {

namespace {

constexpr int least_soundings = 100;
constexpr std::size_t least_angles = 6;
// The standard deviation of normal numbers over the median of their sizes.
constexpr double deviation_of_median = 1.4826;

struct Sums {
    double count = 0.0, angle = 0.0, range = 0.0, power = 0.0;
    std::vector<double> bends;  ///< second differences of depth, as ranges
};

void add_ping(const RecordedSoundings& ping, const RecordedLaw& law, double slope_rad,
              std::map<int, Sums>& by_angle) {
    const auto depth = [&](std::size_t j) {
        return ping.range_m[j] * sincos(static_cast<double>(ping.angle_rad[j])).cos;
    };
    for (std::size_t j = 0; j < ping.range_m.size(); ++j) {
        const double angle = std::fabs(ping.angle_rad[j] - slope_rad);
        Sums& sums = by_angle[static_cast<int>(degrees(angle) / angle_step_deg)];
        sums.count += 1.0;
        sums.angle += angle;
        sums.range += ping.range_m[j];
        sums.power += power_of(law, ping.intensity[j]);
        if (j == 0 || j + 1 == ping.range_m.size()) continue;
        // Beams are not evenly spaced, so the line through the neighbours gives their depth here.
        const auto across = [&](std::size_t k) {
            return ping.range_m[k] * sincos(static_cast<double>(ping.angle_rad[k])).sin;
        };
        const double part = (across(j) - across(j - 1)) / (across(j + 1) - across(j - 1));
        if (!(part > 0.1 && part < 0.9)) continue;
        const double line = (1.0 - part) * depth(j - 1) + part * depth(j + 1);
        const double shares = 1.0 + part * part + (1.0 - part) * (1.0 - part);
        const double bend = (depth(j) - line) / std::sqrt(shares);
        sums.bends.push_back(bend / sincos(static_cast<double>(ping.angle_rad[j])).cos);
    }
}

double spread_without_outliers(std::vector<double> bends) {
    if (bends.size() < 10) return 0.0;
    for (double& bend : bends)
        bend = std::fabs(bend);
    std::vector<double> sorted = bends;
    std::sort(sorted.begin(), sorted.end());
    const double most = 6.0 * deviation_of_median * sorted[sorted.size() / 2];
    double sum = 0.0, count = 0.0;
    for (const double bend : bends) {
        if (bend > most) continue;
        sum += bend * bend;
        count += 1.0;
    }
    return std::sqrt(sum / count);
}

double tangent_of(double angle) {
    const SinCos at = sincos(angle);
    return at.sin / at.cos;
}

/// Lambert's rule and facets, 0 dB for Lambert's at normal incidence.
double rule_db(double facets_db, double slope_rms_deg, double angle_rad) {
    const double cosine = sincos(angle_rad).cos;
    const double slope = std::max(tangent_of(radians(slope_rms_deg)), 1e-3);
    const double tangent = tangent_of(angle_rad);
    const double facets = power_of_db(facets_db) *
                          exponential(-tangent * tangent / (2.0 * slope * slope)) /
                          power(cosine, 4.0);
    return db_of_power(cosine * cosine + facets);
}

/// Lambert's level, facets and slope, fitted to the strengths.
std::vector<double> bottom_of(const std::vector<double>& angles,
                              const std::vector<double>& strengths) {
    const auto slope = [](double x) { return std::clamp(std::fabs(x), 0.5, 60.0); };
    const auto residuals = [&](const Eigen::VectorXd& x) {
        Eigen::VectorXd out(static_cast<Eigen::Index>(angles.size()));
        for (std::size_t k = 0; k < angles.size(); ++k)
            out[static_cast<Eigen::Index>(k)] =
                x[0] + rule_db(x[1], slope(x[2]), angles[k]) - strengths[k];
        return out;
    };
    std::vector<double> best;
    double least = 1e300;
    for (const double first : {5.0, 15.0, 30.0}) {
        Eigen::VectorXd start(3);
        start << strengths.back(), 3.0, first;
        const Eigen::VectorXd x =
            least_squares_fit(start, static_cast<int>(angles.size()), residuals);
        const double error = residuals(x).squaredNorm();
        if (error >= least) continue;
        least = error;
        best = {x[0], x[1], slope(x[2])};
    }
    return best;
}

/// The value of a table at an angle, by a line between the nearest two.
double in_table(const std::vector<double>& angles, const std::vector<Bounded>& table,
                double angle) {
    const auto after = std::upper_bound(angles.begin(), angles.end(), angle);
    if (after == angles.begin()) return table.front().value;
    if (after == angles.end()) return table.back().value;
    const auto k = static_cast<std::size_t>(after - angles.begin());
    const double part = (angle - angles[k - 1]) / (angles[k] - angles[k - 1]);
    return (1.0 - part) * table[k - 1].value + part * table[k].value;
}

/// The strengths, then the spreads, of drawn soundings at the angles of all soundings; NaN at
/// angles without drawn soundings.
std::vector<double> row_of(const std::vector<SoundingsAtAngle>& whole,
                           const std::vector<SoundingsAtAngle>& drawn,
                           const SoundingsGeometry& geometry) {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> out(2 * whole.size(), missing);
    for (std::size_t k = 0; k < whole.size(); ++k) {
        for (const SoundingsAtAngle& a : drawn) {
            if (std::fabs(a.angle_rad - whole[k].angle_rad) > radians(0.5 * angle_step_deg))
                continue;
            out[k] = a.level_db - geometry.gain_db(a.angle_rad, a.range_m);
            out[whole.size() + k] = a.spread_m;
        }
    }
    return out;
}

}  // namespace

std::vector<SoundingsAtAngle> soundings_by_angle(const std::vector<RecordedSoundings>& pings,
                                                 const RecordedLaw& law, double slope_rad) {
    std::map<int, Sums> by_angle;
    for (const RecordedSoundings& ping : pings)
        add_ping(ping, law, slope_rad, by_angle);
    std::vector<SoundingsAtAngle> out;
    for (const auto& [number, sums] : by_angle) {
        if (sums.count < least_soundings) continue;
        out.push_back({.angle_rad = sums.angle / sums.count,
                       .range_m = sums.range / sums.count,
                       .level_db = db_of_power(sums.power / sums.count),
                       .spread_m = spread_without_outliers(sums.bends),
                       .count = static_cast<int>(sums.count)});
    }
    std::erase_if(out, [](const SoundingsAtAngle& a) { return !(a.spread_m > 0.0); });
    return out;
}

double SoundingsGeometry::gain_db(double angle_rad, double range_m) const {
    const double across = std::min(width_rad * range_m / sincos(angle_rad).cos,
                                   pulse_m / std::max(sincos(angle_rad).sin, 1e-6));
    return db_of_power(across * range_m) - (4.0 - 0.1 * tvg_log) * db_of_power(range_m);
}

double SoundingsFit::strength_db_at(double angle_rad) const {
    return in_table(angles_rad, strength_db, angle_rad);
}

double SoundingsFit::spread_m_at(double angle_rad) const {
    return in_table(angles_rad, spread_m, angle_rad);
}

SoundingsFit fit_soundings(const std::vector<RecordedSoundings>& pings, const RecordedLaw& law,
                           double slope_rad, const SoundingsGeometry& geometry) {
    const std::vector<SoundingsAtAngle> whole = soundings_by_angle(pings, law, slope_rad);
    if (whole.size() < least_angles) {
        throw InputError(
            "fewer than six angles, 4 degrees apart, have 100 soundings: record more "
            "pings");
    }
    SoundingsFit out;
    out.geometry = geometry;
    for (const SoundingsAtAngle& a : whole)
        out.angles_rad.push_back(a.angle_rad);
    // The units of the bootstrap are stretches of pings: neighbours see the same bottom.
    constexpr int stretches = 20;
    const auto estimate = [&](const std::vector<double>& weights) {
        std::vector<RecordedSoundings> chosen;
        for (std::size_t k = 0; k < pings.size(); ++k) {
            const std::size_t stretch = k * stretches / pings.size();
            chosen.insert(chosen.end(), static_cast<std::size_t>(weights[stretch]), pings[k]);
        }
        std::vector<double> all =
            row_of(whole, soundings_by_angle(chosen, law, slope_rad), geometry);
        const std::vector<double> strengths(
            all.begin(), all.begin() + static_cast<std::ptrdiff_t>(whole.size()));
        const std::vector<double> bottom = bottom_of(out.angles_rad, strengths);
        all.insert(all.end(), bottom.begin(), bottom.end());
        return all;
    };
    const std::size_t count = whole.size();
    const std::vector<Bounded> found =
        bootstrap_all(stretches, estimate, std::vector<double>(2 * count + 3), 40);
    const auto at = [&](std::size_t k) { return found.begin() + static_cast<std::ptrdiff_t>(k); };
    out.strength_db.assign(at(0), at(count));
    out.spread_m.assign(at(count), at(2 * count));
    out.lambert_db = found[2 * count];
    out.facets_db = found[2 * count + 1];
    out.slope_rms_deg = found[2 * count + 2];
    return out;
}

}  // namespace sonarsim
