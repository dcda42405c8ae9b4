#pragma once

#include "input/scene/surface.h"
#include "support/test.h"

namespace sonarsim::test {

/// A bottom of 40 x 40 cells of half a metre about the origin. height() computes its height
/// independently: the diagonal of a cell runs from its corner of least x and y to that of largest.
struct Waves {
    static constexpr int cells = 40;
    static constexpr double cell_m = 0.5;
    static constexpr double half_m = 0.5 * cells * cell_m;

    static double node(int i, int j) {
        return 0.4 * std::sin(0.9 * i) * std::cos(0.7 * j) + 0.05 * ((i * 7 + j * 13) % 5);
    }
    static Surface surface() {
        Surface out;
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i)
                out.vertices.emplace_back(i * cell_m - half_m, j * cell_m - half_m, node(i, j));
        }
        for (std::uint32_t j = 0; j < cells; ++j) {
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t a = j * (cells + 1) + i;
                out.triangles.push_back({a, a + 1, a + cells + 2});
                out.triangles.push_back({a, a + cells + 2, a + cells + 1});
            }
        }
        return out;
    }
    static double height(double x, double y) {
        const double u = (x + half_m) / cell_m;
        const double v = (y + half_m) / cell_m;
        const int i = std::clamp(static_cast<int>(u), 0, cells - 1);
        const int j = std::clamp(static_cast<int>(v), 0, cells - 1);
        const double s = u - i;
        const double t = v - j;
        const double diagonal = node(i + 1, j + 1);
        return s >= t ? node(i, j) + s * (node(i + 1, j) - node(i, j)) +
                            t * (diagonal - node(i + 1, j))
                      : node(i, j) + t * (node(i, j + 1) - node(i, j)) +
                            s * (diagonal - node(i, j + 1));
    }
};

}  // namespace sonarsim::test
