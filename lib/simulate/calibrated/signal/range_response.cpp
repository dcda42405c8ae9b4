#include "simulate/calibrated/signal/range_response.h"

#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/signal/directivity.h"

namespace sonarsim {

namespace {

/// The half-power width for which line_array() designs a band: any small angle works.
constexpr double unit_width = 1e-3;

// Pulses are cut off at the greatest `range_bins`.
constexpr double max_reach = 8192.0;

/// The bins to either side of a pulse's middle that have its main lobe and two side lobes.
int reach_of(double resolution_bins) {
    return static_cast<int>(std::clamp(std::ceil(3.0 * resolution_bins), 2.0, max_reach));
}

/// The square root of the spectrum of noise after a matched filter, `frequency` in cycles per bin.
/// The pulse's band is `width` cycles per bin wide; beyond half a cycle it aliases.
double noise_amplitude(const LineArray& band, double width, double frequency) {
    const int reach = static_cast<int>(std::ceil(0.5 * width));
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k)
        sum += std::abs(band.weight((frequency + k) / width));
    return std::sqrt(sum);
}

/// Solves t[m-1] / 6 + 2 t[m] / 3 + t[m+1] / 6 = b[m], the normal equations of a linear spline.
std::vector<double> solve_triangles(std::vector<double> b) {
    const std::size_t n = b.size();
    std::vector<double> diagonal(n, 2.0 / 3.0);
    for (std::size_t m = 1; m < n; ++m) {
        const double factor = 1.0 / 6.0 / diagonal[m - 1];
        diagonal[m] -= factor / 6.0;
        b[m] -= factor * b[m - 1];
    }
    for (std::size_t m = n; m-- > 0;) {
        if (m + 1 < n) b[m] -= b[m + 1] / 6.0;
        b[m] /= diagonal[m];
    }
    return b;
}

}  // namespace

RangeTaps range_taps(double resolution_bins, double side_lobe_db) {
    const LineArray band = line_array(unit_width, side_lobe_db);
    const auto response = [&](double bins) {
        return line_pattern(band, bins / resolution_bins * unit_width);
    };
    RangeTaps out;
    out.reach = reach_of(resolution_bins);
    std::vector<double> products;
    constexpr int steps = 64;
    for (int m = -out.reach; m <= out.reach; ++m) {
        double sum = 0.0;
        for (int k = -steps + 1; k < steps; ++k) {
            const double x = static_cast<double>(k) / steps;
            sum += (1.0 - std::fabs(x)) * response(m + x) / steps;
        }
        products.push_back(sum);
    }
    double power = 0.0;
    double neighbours = 0.0;
    const std::vector<double> taps = solve_triangles(std::move(products));
    for (std::size_t m = 0; m < taps.size(); ++m) {
        power += taps[m] * taps[m];
        if (m > 0) neighbours += taps[m] * taps[m - 1];
    }
    // A spline cannot follow a pulse as short as a bin, so it is scaled to the pulse's energy.
    const double spline_energy = 2.0 / 3.0 * power + 1.0 / 3.0 * neighbours;
    double energy = 0.0;
    for (int k = -steps * out.reach; k <= steps * out.reach; ++k) {
        const double h = response(static_cast<double>(k) / steps);
        energy += h * h / steps;
    }
    const double scale = std::sqrt(energy / spline_energy);
    for (const double tap : taps)
        out.taps.push_back(static_cast<float>(scale * tap));
    out.scalloping_gain = static_cast<float>(spline_energy / power);
    return out;
}

RangeTaps power_taps(RangeTaps amplitudes) {
    for (float& tap : amplitudes.taps)
        tap *= amplitudes.scalloping_gain * tap;
    return amplitudes;
}

std::vector<float> noise_taps(double resolution_bins, double side_lobe_db) {
    // A shorter pulse has white noise as well.
    const double pulse_bins = std::max(resolution_bins, 0.1);
    const LineArray band = line_array(unit_width, side_lobe_db);
    const double width = band.wavelengths * unit_width / pulse_bins;
    const double max_frequency = 0.5 * std::min(width, 1.0);
    constexpr int steps = 512;
    std::vector<double> one_side;  // from the middle on
    double energy = 0.0;
    for (int m = 0; m <= reach_of(pulse_bins); ++m) {
        double tap = 0.0;
        for (int k = 0; k < steps; ++k) {
            const double frequency = max_frequency * (k + 0.5) / steps;
            tap += noise_amplitude(band, width, frequency) * sincos(2.0 * pi * m * frequency).cos /
                   steps;
        }
        one_side.push_back(tap);
        energy += (m == 0 ? 1.0 : 2.0) * tap * tap;
    }
    // Drops taps at the ends, up to a thousandth of the energy.
    double left_out = 0.0;
    while (one_side.size() > 1) {
        const double more = 2.0 * one_side.back() * one_side.back();
        if (left_out + more > 1e-3 * energy) break;
        left_out += more;
        one_side.pop_back();
    }
    std::vector<float> taps;
    const double scale = 1.0 / std::sqrt(energy - left_out);
    const int reach = static_cast<int>(one_side.size()) - 1;
    for (int m = -reach; m <= reach; ++m)
        taps.push_back(static_cast<float>(scale * one_side[std::abs(m)]));
    return taps;
}

PulseBand pulse_band(const PulseConfig& pulse, double bin_m, double sound_speed_m_s) {
    const double resolution_m = pulse.resolution_m > 0.0 ? pulse.resolution_m : bin_m;
    const LineArray band = line_array(unit_width, pulse.side_lobe_db);
    const double k = band.wavelengths * unit_width;
    PulseBand out;
    out.sweep_hz = k * sound_speed_m_s / (2.0 * resolution_m);
    out.pulse_s = std::max(pulse.duration_s, 1.0 / out.sweep_hz);
    out.noise_hz = taper_loss(band) / out.pulse_s;
    out.length_m = taper_loss(band) * resolution_m / k;
    return out;
}

}  // namespace sonarsim
