#pragma once

#include <vector>

namespace sonarsim {

/// Strengths of K-distributed clutter: gamma-distributed with shape nu and mean 1, by cells of the
/// scene larger than the resolution.
struct Clutter {
    static constexpr int steps = 1024;
    float edge_m = 0.0F;
    std::vector<float> strength;  ///< [steps] quantiles; empty: 1 everywhere
};

/// nu = 0: no clutter.
Clutter gamma_clutter(double shape, double edge_m);

}  // namespace sonarsim
