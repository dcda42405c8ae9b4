#pragma once

#include "input/scene/seabed/seabed.h"
#include "support/test.h"

namespace sonarsim::test {

/// The power of a bed's heights at one wave vector, rad/m: the periodogram with Hann's window,
/// whose mean is the spectrum W, m^4, smoothed over two of the bed's wave numbers. It has an
/// exponential distribution.
inline double spectrum_at(const Seabed& bed, double kx, double ky) {
    const BedGrid& grid = bed.grid;
    const auto window = [](int i, int count) {
        return 0.5 - 0.5 * std::cos(2.0 * pi * (i + 0.5) / count);
    };
    std::vector<std::complex<double>> across;
    double weight_x = 0.0;
    for (int column = 0; column < grid.columns; ++column) {
        const double w = window(column, grid.columns);
        weight_x += w * w;
        across.push_back(w * std::polar(1.0, -kx * grid.x_m(column)));
    }
    std::complex<double> sum;
    double weight_y = 0.0;
    for (int row = 0; row < grid.rows; ++row) {
        std::complex<double> of_row;
        const float* z = &bed.heights[static_cast<std::size_t>(row) * across.size()];
        for (std::size_t i = 0; i < across.size(); ++i)
            of_row += across[i] * static_cast<double>(z[i]);
        const double w = window(row, grid.rows);
        weight_y += w * w;
        sum += of_row * w * std::polar(1.0, -ky * grid.y_m(row));
    }
    const double cell = grid.cell_m;
    return std::norm(sum) * cell * cell / (4.0 * pi * pi * weight_x * weight_y);
}

}  // namespace sonarsim::test
