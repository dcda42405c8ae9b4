#include "compare/measure_soundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "core/units.h"
#include "recording/law.h"

namespace sonarsim {

namespace {

constexpr double band_width = pi / 18.0;
constexpr std::size_t pings_in_group = 8;
constexpr std::size_t fewest_in_band = 6;

/// The soundings of one ping in one band: offsets of the angle from its middle, ranges, powers.
struct BandSoundings {
    std::vector<double> offset;
    std::vector<double> range;
    std::vector<double> power;
};

/// The root mean square distance of ranges from their parabola over the angle, over the mean range.
/// The sum of n squares is divided by n - 3, since the fit has three parameters.
double spread_of_ranges(const BandSoundings& own) {
    const std::size_t n = own.range.size();
    double moments[5] = {};
    double right[3] = {};
    double mean = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        mean += own.range[i] / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
        double term = 1.0;
        for (int k = 0; k < 5; ++k) {
            moments[k] += term;
            if (k < 3) right[k] += term * (own.range[i] - mean);
            term *= own.offset[i] / band_width;
        }
    }
    double rows[3][4];
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            rows[r][c] = moments[r + c];
        rows[r][3] = right[r];
    }
    for (int r = 0; r < 3; ++r) {  // Gauss and Jordan; the matrix is positive definite
        if (!(std::fabs(rows[r][r]) > 1e-12)) return std::numeric_limits<double>::quiet_NaN();
        for (int other = 0; other < 3; ++other) {
            if (other == r) continue;
            const double factor = rows[other][r] / rows[r][r];
            for (int c = 0; c < 4; ++c)
                rows[other][c] -= factor * rows[r][c];
        }
    }
    double square = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = own.offset[i] / band_width;
        const double fit =
            rows[0][3] / rows[0][0] + x * (rows[1][3] / rows[1][1] + x * rows[2][3] / rows[2][2]);
        square += (own.range[i] - mean - fit) * (own.range[i] - mean - fit);
    }
    return std::sqrt(square / static_cast<double>(n - 3)) / mean;
}

BandSoundings soundings_in(const RecordedSoundings& ping, const RecordedLaw& law, double from) {
    BandSoundings own;
    for (std::size_t i = 0; i < ping.range_m.size(); ++i) {
        const double offset = ping.angle_rad[i] - from;
        if (offset < 0.0 || offset >= band_width) continue;
        own.offset.push_back(offset - 0.5 * band_width);
        own.range.push_back(ping.range_m[i]);
        own.power.push_back(power_of(law, ping.intensity[i]));
    }
    return own;
}

void measure_band(const Recording& recording, double from, double unit_power, Measurement& out) {
    const std::string degrees = number_text(std::round(from * 180.0 / pi)) + " to " +
                                number_text(std::round((from + band_width) * 180.0 / pi)) +
                                " degrees";
    Measured level{degrees + ": level, dB", Reduce::level, Tolerance::decibel, 0.5, {}};
    Measured variation{degrees + ": variation of power", Reduce::mean, Tolerance::tenth, 0.5, {}};
    Measured spread{degrees + ": spread of ranges, %", Reduce::mean, Tolerance::tenth, 0.5, {}};
    for (std::size_t k = 0; k < recording.soundings.size(); ++k) {
        const BandSoundings own = soundings_in(recording.soundings[k], recording.law, from);
        if (own.range.size() < fewest_in_band) continue;
        const int group = static_cast<int>(k / pings_in_group);
        const auto n = static_cast<double>(own.power.size());
        double mean = 0.0;
        double square = 0.0;
        for (const double power : own.power) {
            mean += power / n;
            square += power * power / n;
        }
        const double deviation = std::sqrt(std::max(0.0, square - mean * mean) * n / (n - 1.0));
        const double off = spread_of_ranges(own);
        level.cells.push_back(
            {group, 0, static_cast<float>(mean / unit_power), static_cast<float>(n)});
        if (mean > 0.0)
            variation.cells.push_back({group, 0, static_cast<float>(deviation / mean), 1.0F});
        if (std::isfinite(off))
            spread.cells.push_back({group, 0, static_cast<float>(100.0 * off), 1.0F});
    }
    for (Measured* figure : {&level, &variation, &spread}) {
        if (!figure->cells.empty()) out.figures.push_back(std::move(*figure));
    }
}

/// The angles between which 98 % of the soundings lie.
CommonAngles angles_of(const Recording& recording) {
    std::vector<float> all;
    for (const RecordedSoundings& ping : recording.soundings)
        all.insert(all.end(), ping.angle_rad.begin(), ping.angle_rad.end());
    if (all.empty()) return {};
    std::ranges::sort(all);
    return {all[all.size() / 100], all[all.size() - 1 - all.size() / 100]};
}

}  // namespace

CommonAngles common_angles(const Recording& a, const Recording& b) {
    const CommonAngles of_a = angles_of(a);
    const CommonAngles of_b = angles_of(b);
    return {std::max(of_a.from_rad, of_b.from_rad), std::min(of_a.to_rad, of_b.to_rad)};
}

double mean_power_of_soundings(const Recording& recording) {
    double sum = 0.0;
    double count = 0.0;
    for (const RecordedSoundings& ping : recording.soundings) {
        for (const float intensity : ping.intensity)
            sum += power_of(recording.law, intensity);
        count += static_cast<double>(ping.intensity.size());
    }
    return sum > 0.0 ? sum / count : 1.0;
}

Measurement measure_soundings(const Recording& recording, CommonAngles angles, double unit_power) {
    Measurement out;
    const int first = static_cast<int>(std::ceil(angles.from_rad / band_width - 0.5));
    const int last = static_cast<int>(std::floor(angles.to_rad / band_width + 0.5));
    for (int band = first; band < last; ++band)
        measure_band(recording, band * band_width, unit_power, out);
    return out;
}

}  // namespace sonarsim
