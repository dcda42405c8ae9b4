#include "calibrated/range_response.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// The half-power width at which line_array() is asked for a band: any small angle will do.
constexpr double unit_width = 1e-3;

/// Solves t[m-1] / 6 + 2 t[m] / 3 + t[m+1] / 6 = b[m]: the products of neighbouring triangles.
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

RangeTaps range_taps(double resolution_bins, double side_lobe_db, bool squared) {
    const LineArray band = line_array(unit_width, side_lobe_db);
    const auto response = [&](double bins) {
        const double h = line_pattern(band, bins / resolution_bins * unit_width);
        return squared ? h * h : h;
    };
    RangeTaps out;
    // The main lobe and two side lobes, but not so many that a wide pulse takes all the time.
    out.reach = static_cast<int>(std::clamp(std::ceil(3.0 * resolution_bins), 2.0, 64.0));
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
    double sum = 0.0;
    double power = 0.0;
    double neighbours = 0.0;
    const std::vector<double> taps = solve_triangles(std::move(products));
    for (std::size_t m = 0; m < taps.size(); ++m) {
        sum += taps[m];
        power += taps[m] * taps[m];
        if (m > 0) neighbours += taps[m] * taps[m - 1];
    }
    // A spline cannot follow a pulse as short as a bin: it is given the same energy.
    const double of_spline = squared ? sum : 2.0 / 3.0 * power + 1.0 / 3.0 * neighbours;
    double energy = 0.0;
    for (int k = -steps * out.reach; k <= steps * out.reach; ++k) {
        const double h = response(static_cast<double>(k) / steps);
        energy += (squared ? h : h * h) / steps;
    }
    const double scale = squared ? energy / of_spline : std::sqrt(energy / of_spline);
    for (const double tap : taps)
        out.taps.push_back(static_cast<float>(scale * tap));
    out.scalloping_gain = static_cast<float>((2.0 / 3.0 * power + 1.0 / 3.0 * neighbours) / power);
    return out;
}

}  // namespace sonarsim
