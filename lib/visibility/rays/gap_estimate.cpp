#include "visibility/rays/gap_estimate.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// At grazing incidence the cosine is the intensity, and what counts is its relative error. Below
// this the surface is too dark to matter.
constexpr float least_cosine = 0.02F;

// Two planes that touch a smooth surface meet half way. There each is off by half of the change in
// cosine from the one to the other, and by a quarter of it in the mean.
constexpr float mean_miss = 0.25F;

// Of five degrees. A ball may fill a single bin, and a corner two, with little at stake; but what
// they mirror goes far apart, and multipath in the tank misses less when they are looked at closer.
constexpr float cosine_of_turn = 0.9962F;

// Of products of a height and a cosine: some roundings of a float.
constexpr float rounding = 1e-6F;

/// Two nodes, and the cosines at which each ray would meet the other's plane.
struct Pair {
    const ChainNode& a;
    const ChainNode& b;
    float cosine_ab;  ///< of b's ray on a's plane
    float cosine_ba;
};

Pair pair_of(const ChainNode& a, const ChainNode& b) {
    return {a, b, -a.normal.dot(b.direction), -b.normal.dot(a.direction)};
}

bool within(const ChainNode& node, float reach_m) {
    return !node.missed() && node.range_m < reach_m;
}

/// Metres of range that a plane could fill between the node's ray and one that meets it at
/// `cosine`, or does not meet it.
float run_m(const ChainNode& node, float cosine, float reach_m) {
    if (node.missed()) return 0.0F;
    const float there = node.height_m < reach_m * cosine ? node.height_m / cosine : reach_m;
    return std::fabs(there - std::min(node.range_m, reach_m));
}

/// Whether each plane predicts the other's range. Both have been met.
bool nearly_one_plane(const Pair& pair, float slack_m) {
    const auto& [a, b, cosine_ab, cosine_ba] = pair;
    return cosine_ab > 0.0F && cosine_ba > 0.0F &&
           std::fabs(a.height_m - b.range_m * cosine_ab) <= slack_m * cosine_ab &&
           std::fabs(b.height_m - a.range_m * cosine_ba) <= slack_m * cosine_ba;
}

float relative_change(float one, float other) {
    return std::fabs(one - other) / std::max({one, other, least_cosine});
}

}  // namespace

Between between(const ChainNode& a, const ChainNode& b, const Sampling& sampling, float reach_m) {
    if (!within(a, reach_m) && !within(b, reach_m)) return {};
    if (a.facet == b.facet) return {};
    const Pair pair = pair_of(a, b);
    const float cosine_ab = pair.cosine_ab;
    const float cosine_ba = pair.cosine_ba;
    const auto broken = [&]() -> Between {
        return {false, 0.5F, std::max(run_m(a, cosine_ab, reach_m), run_m(b, cosine_ba, reach_m))};
    };
    if (a.missed() || b.missed()) return broken();
    const bool same = a.material == b.material;
    // What is at stake where `m` metres of the two planes lie between the rays.
    const auto joined = [&](float border, float m) -> Between {
        const float off = same ? mean_miss * std::max(relative_change(a.cosine, cosine_ba),
                                                      relative_change(b.cosine, cosine_ab))
                               : 1.0F;
        return {true, border, off * m, a.normal.dot(b.normal) < cosine_of_turn};
    };
    // In a direction of cosines c_a and c_b, plane a is nearer where h_a c_b < h_b c_a. Cosines are
    // as good as linear in the angle between the rays: where the order of the planes changes, they
    // cross.
    const float at_a = a.height_m * cosine_ba - b.height_m * a.cosine;
    const float at_b = a.height_m * b.cosine - b.height_m * cosine_ab;
    if ((at_a < 0.0F) != (at_b < 0.0F) &&
        std::fabs(at_a - at_b) > rounding * (a.height_m + b.height_m)) {
        const float border = at_a / (at_a - at_b);
        const float cosine_a = a.cosine + border * (cosine_ab - a.cosine);
        const float cosine_b = cosine_ba + border * (b.cosine - cosine_ba);
        if (cosine_a > 0.0F && cosine_b > 0.0F) {
            return joined(border, run_m(a, cosine_a, reach_m) + run_m(b, cosine_b, reach_m));
        }
    }
    if (same && nearly_one_plane(pair, sampling.tolerance_m)) {
        return joined(0.5F, std::fabs(std::min(b.range_m, reach_m) - std::min(a.range_m, reach_m)));
    }
    return broken();
}

float next_along(const ChainNode& a, const ChainNode& b, float reach_m) {
    const float middle = 0.5F * (a.along + b.along);
    if (within(a, reach_m) == within(b, reach_m)) return middle;
    // Beside nothing within reach, a surface at grazing incidence may run on up to the reach in
    // hardly any angle. A ray to where its plane leaves the reach tells.
    const ChainNode& node = within(a, reach_m) ? a : b;
    const ChainNode& other = within(a, reach_m) ? b : a;
    const float leaves = node.height_m / (reach_m * (1.0F + 0.5F * beyond));
    const float at_other = -node.normal.dot(other.direction);
    const float share = (node.cosine - leaves) / (node.cosine - at_other);
    // So near to an end lies what a ray has told before.
    constexpr float told = 0.01F;
    return at_other < leaves && share > told && share < 1.0F - told
               ? node.along + share * (other.along - node.along)
               : middle;
}

bool disagree(const ChainNode& a, const ChainNode& b, const Sampling& sampling, float reach_m) {
    if (!within(a, reach_m) && !within(b, reach_m)) return false;
    if (a.missed() || b.missed()) return true;
    if (a.facet == b.facet) return false;
    const Pair pair = pair_of(a, b);
    return a.material != b.material || !nearly_one_plane(pair, sampling.tolerance_m) ||
           std::fabs(pair.cosine_ab - b.cosine) >
               sampling.tolerance_cosine * std::max(b.cosine, least_cosine);
}

}  // namespace sonarsim
