#include "compare/figures/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sonarsim {

namespace {

/// A trend that falls below this share of the mean power is that of an edge.
constexpr double least_trend = 0.15;

double product_of(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Gram and Schmidt: makes `vector` orthogonal to the basis, with a length of 1, and adds it.
void add_orthonormal(std::vector<std::vector<double>>& basis, std::vector<double> vector) {
    for (const std::vector<double>& other : basis) {
        const double share = product_of(vector, other);
        for (std::size_t i = 0; i < vector.size(); ++i)
            vector[i] -= share * other[i];
    }
    const double length = std::sqrt(product_of(vector, vector));
    if (length < 1e-9) return;  // a patch of one column or row leaves no remainder
    for (double& value : vector)
        value /= length;
    basis.push_back(std::move(vector));
}

}  // namespace

Detrender::Detrender(PatchSize size) {
    const auto rows = static_cast<std::size_t>(size.ranges);
    const auto columns = static_cast<std::size_t>(size.beams);
    const auto place = [](std::size_t k, std::size_t count) {
        return count > 1 ? 2.0 * static_cast<double>(k) / static_cast<double>(count - 1) - 1.0
                         : 0.0;
    };
    for (int term = 0; term < 6; ++term) {
        std::vector<double> vector;
        for (std::size_t i = 0; i < rows; ++i) {
            for (std::size_t j = 0; j < columns; ++j) {
                const double y = place(i, rows);
                const double x = place(j, columns);
                const double terms[] = {1.0, x, y, x * y, x * x, y * y};
                vector.push_back(terms[term]);
            }
        }
        add_orthonormal(basis_, std::move(vector));
    }
}

std::optional<Patch> Detrender::patch_of(const ImageView& image, const PatchGrid& grid,
                                         int place) const {
    std::vector<double> power;
    grid.for_each_bin(image, place, [&](float value, int, int) { power.push_back(value); });
    const auto n = static_cast<double>(power.size());
    Patch patch;
    patch.mean_power = std::accumulate(power.begin(), power.end(), 0.0) / n;
    if (!(patch.mean_power > 0.0)) return std::nullopt;
    std::vector<double> trend(power.size());
    for (const std::vector<double>& function : basis_) {
        const double share = product_of(power, function);
        for (std::size_t i = 0; i < trend.size(); ++i)
            trend[i] += share * function[i];
    }
    if (*std::ranges::min_element(trend) <= least_trend * patch.mean_power) return std::nullopt;
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < trend.size(); ++i) {
        square += (trend[i] - patch.mean_power) * (trend[i] - patch.mean_power) / n;
        total += power[i] / trend[i] / n;
    }
    patch.trend = std::sqrt(square) / patch.mean_power;
    if (!(total > 0.0)) return std::nullopt;
    for (std::size_t i = 0; i < trend.size(); ++i)
        patch.amplitude.push_back(static_cast<float>(std::sqrt(power[i] / trend[i] / total)));
    return patch;
}

}  // namespace sonarsim
