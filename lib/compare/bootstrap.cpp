#include "compare/bootstrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "compare/reduced.h"
#include "compare/student.h"
#include "core/resampling.h"

namespace sonarsim {

namespace {

constexpr int replicates = 300;
constexpr int cell_replicates = 100;
constexpr int fewest_locations = 8;

enum class Units : std::uint32_t { locations = 1, pings = 2, cells = 3 };

int unit_of(const Cell& cell, Units units) {
    return units == Units::locations ? cell.location : cell.ping;
}

/// The cells of a mean summed by unit, since a draw gives all cells of a unit the same weight.
Measured joined(const Measured& figure, Units units) {
    if (figure.reduce == Reduce::quantile || units == Units::cells) return figure;
    Measured out = figure;
    std::ranges::stable_sort(out.cells, {}, [&](const Cell& cell) { return unit_of(cell, units); });
    std::size_t count = 0;
    for (const Cell& cell : out.cells) {
        if (count > 0 && unit_of(out.cells[count - 1], units) == unit_of(cell, units)) {
            Cell& last = out.cells[count - 1];
            const double weight = static_cast<double>(last.weight) + cell.weight;
            last.value = static_cast<float>((static_cast<double>(last.value) * last.weight +
                                             static_cast<double>(cell.value) * cell.weight) /
                                            weight);
            last.weight = static_cast<float>(weight);
            continue;
        }
        out.cells[count++] = cell;
    }
    out.cells.resize(count);
    return out;
}

/// The value of a figure in a draw of weights for its units. A draw has one weight for a unit that
/// two figures share, if they share the key.
double value_in_draw(const Measured& cells, Units units, std::uint32_t draw, PhiloxKey key) {
    const auto weight = [&](std::uint32_t a, std::uint32_t b) {
        return drawn_weight({draw, a, b, 0x626f6f74U}, key);
    };
    if (units == Units::cells) {
        return reduced(cells, [&](const Cell& c) {
            return c.weight * weight(static_cast<std::uint32_t>(c.location),
                                     static_cast<std::uint32_t>(c.ping));
        });
    }
    int last = 0;
    for (const Cell& cell : cells.cells)
        last = std::max(last, unit_of(cell, units));
    std::vector<double> weights(static_cast<std::size_t>(last) + 1);
    for (std::size_t u = 0; u < weights.size(); ++u)
        weights[u] = weight(static_cast<std::uint32_t>(u), 0);
    return reduced(cells, [&](const Cell& c) {
        return c.weight * weights[static_cast<std::size_t>(unit_of(c, units))];
    });
}

/// The variances over draws of the real figure, of the simulated one, and of their difference.
std::vector<double> variances_over(Units units, const Measured& real, const Measured& simulated,
                                   bool is_paired, std::uint32_t seed) {
    const Measured a = joined(real, units);
    const Measured b = joined(simulated, units);
    const auto number = static_cast<std::uint32_t>(units) * 2U;
    const PhiloxKey key = {seed, number};
    const PhiloxKey key_of_simulated = {seed, is_paired ? number : number + 1U};
    const auto in_draw = [&](std::uint32_t draw) {
        const double x = value_in_draw(a, units, draw, key);
        const double y = value_in_draw(b, units, draw, key_of_simulated);
        return std::vector<double>{x, y, x - y};
    };
    const int draws = units == Units::cells ? cell_replicates : replicates;
    std::vector<double> out = drawn_variances(in_draw(0), draws, in_draw);
    for (double& variance : out)
        variance *= draws / (draws - 1.0);
    return out;
}

/// The change of a figure when the cells of a unit are left out, by unit; 0 for units without any.
std::vector<double> influences(const Measured& figure, std::size_t units) {
    const Measured cells = joined(figure, Units::locations);
    const double all = reduced(cells, [](const Cell& c) { return static_cast<double>(c.weight); });
    std::vector<double> out(units);
    for (std::size_t u = 0; u < units; ++u) {
        const double without = reduced(cells, [&](const Cell& c) {
            return static_cast<std::size_t>(c.location) == u ? 0.0 : static_cast<double>(c.weight);
        });
        if (std::isfinite(without)) out[u] = without - all;
    }
    return out;
}

/// The degrees of freedom of a variance to which locations contribute unequally: normal
/// contributions x of n equal variances have the expectation 3 / (n + 2) of sum(x^4) / sum(x^2)^2.
/// A few bright places then count as few.
double degrees_of(const Measured& real, const Measured& simulated, bool is_paired, int locations) {
    std::size_t units = 1;
    for (const Measured* figure : {&real, &simulated}) {
        for (const Cell& cell : figure->cells)
            units = std::max(units, static_cast<std::size_t>(cell.location) + 1);
    }
    std::vector<double> all = influences(simulated, units);
    std::vector<double> of_real = influences(real, units);
    if (is_paired) {
        std::transform(all.begin(), all.end(), of_real.begin(), all.begin(), std::minus<>());
    } else {
        all.insert(all.end(), of_real.begin(), of_real.end());
    }
    double second = 0.0;
    double fourth = 0.0;
    for (const double x : all) {
        second += x * x;
        fourth += x * x * x * x;
    }
    const double most = locations - 1.0;
    return fourth > 0.0 ? std::clamp(3.0 * second * second / fourth - 2.0, 1.0, most) : most;
}

int count_of(const Measured& figure, Units units) {
    std::set<int> found;
    for (const Cell& cell : figure.cells)
        found.insert(unit_of(cell, units));
    return static_cast<int>(found.size());
}

/// The Bayesian bootstrap of n units has (n - 1) / (n + 1) of the true variance.
double corrected(double drawn, int units) {
    return units > 1 ? drawn * (units + 1.0) / (units - 1.0) : 0.0;
}

struct Variance {
    double locations = 0.0;
    double pings = 0.0;  ///< in excess of the variance over cells
    double all() const { return locations + pings; }
};

Variance joined_variance(double locations, double pings, double cells, int location_count,
                         int ping_count) {
    Variance out{corrected(locations, location_count), 0.0};
    if (ping_count > 1) out.pings = std::max(0.0, corrected(pings, ping_count) - cells);
    return out;
}

}  // namespace

double value_of(const Measured& figure) {
    Measured sorted = figure;
    sort_quantile(sorted);
    return reduced(sorted, [](const Cell& cell) { return static_cast<double>(cell.weight); });
}

Estimate estimate(const Measured& real_figure, const Measured& simulated_figure, Pairing pairing,
                  std::uint32_t seed) {
    Measured real = real_figure;
    Measured simulated = simulated_figure;
    sort_quantile(real);
    sort_quantile(simulated);
    Estimate out;
    const auto plain = [](const Cell& cell) { return static_cast<double>(cell.weight); };
    out.real = reduced(real, plain);
    out.simulated = reduced(simulated, plain);
    if (!std::isfinite(out.real) || !std::isfinite(out.simulated)) return out;
    const int locations =
        std::min(count_of(real, Units::locations), count_of(simulated, Units::locations));
    const int pings = std::min(count_of(real, Units::pings), count_of(simulated, Units::pings));
    std::array<std::vector<double>, 3> drawn;
    drawn.fill(std::vector<double>(3));
    for (const Units units : {Units::locations, Units::pings, Units::cells}) {
        if (units != Units::locations && pings < 2) continue;
        const bool is_paired = units == Units::locations ? pairing.locations
                               : units == Units::pings   ? pairing.pings
                                                         : pairing.locations && pairing.pings;
        drawn[static_cast<std::size_t>(units) - 1] =
            variances_over(units, real, simulated, is_paired, seed);
    }
    const auto of = [&](std::size_t k) {
        return joined_variance(drawn[0][k], drawn[1][k], drawn[2][k], locations, pings);
    };
    out.real_error = std::sqrt(of(0).all());
    out.simulated_error = std::sqrt(of(1).all());
    const Variance difference = of(2);
    out.difference_error = std::sqrt(difference.all());
    if (locations < fewest_locations) return out;
    const double least = 1e-9 * (std::fabs(out.real) + std::fabs(out.simulated)) + 1e-30;
    if (out.difference_error < least) {
        out.degrees = locations - 1.0;
        out.p = std::fabs(out.simulated - out.real) <= least ? 1.0 : 0.0;
        return out;
    }
    // Satterthwaite's degrees of freedom.
    const double of_locations = difference.locations * difference.locations /
                                degrees_of(real, simulated, pairing.locations, locations);
    const double of_pings = pings > 1 ? difference.pings * difference.pings / (pings - 1.0) : 0.0;
    out.degrees = difference.all() * difference.all() / (of_locations + of_pings);
    out.p = student_tails((out.simulated - out.real) / out.difference_error, out.degrees);
    return out;
}

}  // namespace sonarsim
