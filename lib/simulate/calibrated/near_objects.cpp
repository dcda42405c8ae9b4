#include "simulate/calibrated/near_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr int cells = 512;  // y / r is divided into these

/// The cells of y / r that a sample may reach, and its ranges.
struct Reach {
    int first_cell, last_cell;
    float near_m, far_m;
};

int cell_of(float sine) {
    return std::clamp(static_cast<int>(0.5F * cells * (sine + 1.0F)), 0, cells - 1);
}

/// A point within h of one at the range r lies within the angle asin(h / r) <= h / (r - h) of it,
/// and so does its y / r. A quarter of a cell more makes up for rounding.
Reach reach_of(const Sample& sample) {
    const Arrival at = arrival_of(sample.position);
    const float r = at.range_m;
    // At least the sum of the lengths of its half edges.
    const float h = std::sqrt(2.0F * (sample.edge_u.squaredNorm() + sample.edge_v.squaredNorm()));
    const float sine = at.direction.y();
    const float half_sine = (h < r ? std::min(h / (r - h), 2.0F) : 2.0F) + 0.5F / cells;
    return {cell_of(sine - half_sine), cell_of(sine + half_sine), r - h, r + h};
}

}  // namespace

NearObjects::NearObjects(const SceneObjects& objects)
    : objects_(objects), from_m_(cells, std::numeric_limits<float>::infinity()) {}

void NearObjects::add(std::span<const Sample> samples) {
    // A piece in a shadow covers at most a tenth of its range to either side (sight_lines.cpp).
    constexpr float before = 0.9F;
    for (const Sample& sample : samples) {
        if (objects_.is_background(objects_.object_of(sample.instance))) continue;
        const Reach reach = reach_of(sample);
        for (int cell = reach.first_cell; cell <= reach.last_cell; ++cell)
            from_m_[cell] = std::min(from_m_[cell], before * reach.near_m);
    }
}

std::vector<Sample> NearObjects::among(std::span<const Sample> samples) const {
    std::vector<Sample> out;
    for (const Sample& sample : samples) {
        const Reach reach = reach_of(sample);
        for (int cell = reach.first_cell; cell <= reach.last_cell; ++cell) {
            if (from_m_[cell] >= reach.far_m) continue;
            out.push_back(sample);
            break;
        }
    }
    return out;
}

}  // namespace sonarsim
