#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "calibrated/decibel.h"
#include "compare/measured.h"

namespace sonarsim {

/// The mid-distribution quantile, interpolated between the values (Parzen 2004), so that it moves
/// smoothly where a value occurs often. `cells` are in the order of their values.
template <class Weight>
double quantile_of(const std::vector<Cell>& cells, double share, const Weight& weight) {
    double all = 0.0;
    for (const Cell& cell : cells)
        all += weight(cell);
    const double wanted = share * all;
    double before = 0.0;
    double last_middle = 0.0;
    double last_value = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < cells.size();) {
        const float value = cells[i].value;
        double own = 0.0;
        for (; i < cells.size() && cells[i].value == value; ++i)
            own += weight(cells[i]);
        const double middle = before + 0.5 * own;
        if (middle >= wanted) {
            if (std::isnan(last_value) || middle <= last_middle) return value;
            return last_value +
                   (value - last_value) * (wanted - last_middle) / (middle - last_middle);
        }
        before += own;
        last_middle = middle;
        last_value = value;
    }
    return last_value;
}

/// The value of a figure whose cells have these weights; NaN without cells.
template <class Weight>
double reduced(const Measured& figure, const Weight& weight) {
    if (figure.cells.empty()) return std::numeric_limits<double>::quiet_NaN();
    if (figure.reduce == Reduce::quantile) return quantile_of(figure.cells, figure.share, weight);
    double sum = 0.0;
    double weights = 0.0;
    for (const Cell& cell : figure.cells) {
        const double own = weight(cell);
        sum += own * cell.value;
        weights += own;
    }
    const double mean = sum / weights;
    return figure.reduce == Reduce::level ? db_of_power(std::max(1e-16, mean)) : mean;
}

/// Quantiles need the cells in the order of their values.
inline void sort_quantile(Measured& figure) {
    if (figure.reduce == Reduce::quantile) std::ranges::stable_sort(figure.cells, {}, &Cell::value);
}

}  // namespace sonarsim
