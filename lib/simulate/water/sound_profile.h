#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sonarsim {

/// The speed of sound by height: linear between nodes, else constant. Layer k ends at node k.
struct SoundProfile {
    std::vector<double> height_m;  ///< world, rising; one node at least
    std::vector<double> speed_m_s;
    /// The speed by which instruments convert times to ranges: half of it times the two-way time.
    double range_speed_m_s = 0.0;

    std::size_t layer_of(double height) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(height_m, height) -
                                        height_m.begin());
    }

    /// Change of speed with height, 1/s.
    double gradient(std::size_t layer) const {
        if (layer == 0 || layer == height_m.size()) return 0.0;
        return (speed_m_s[layer] - speed_m_s[layer - 1]) / (height_m[layer] - height_m[layer - 1]);
    }

    /// The speed at a height by the line of a layer.
    double speed_in(std::size_t layer, double height) const {
        const std::size_t node = layer == 0 ? 0 : layer - 1;
        return speed_m_s[node] + gradient(layer) * (height - height_m[node]);
    }

    double speed_at(double height) const { return speed_in(layer_of(height), height); }
};

}  // namespace sonarsim
