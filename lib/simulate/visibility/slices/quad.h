#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulate/visibility/slices/slice_frames.h"

namespace sonarsim {

/// A side of a quadrilateral of the picture plane: two points of a vertical.
struct QuadSide {
    float u;
    float low, high;  ///< w
};

/// Four points of a plane in the frame.
struct QuadPoints {
    Eigen::Array4f X, U, W;
    Eigen::Array4f range;
    Eigen::Array4f u, w;  ///< directions to the points

    Eigen::Vector3f at(int k) const { return {X[k], U[k], W[k]}; }
    Eigen::Vector3f middle(int i, int k) const { return 0.5F * (at(i) + at(k)); }
};

/// A visible part of a plane of the scene, between two verticals of the picture plane and two
/// lines.
struct Quad {
    std::uint32_t facet_index;  ///< index of its FrontFacet
    bool widens;                ///< its u is that of w = 0 and grows with sqrt(1 + w^2)
    QuadSide low, high;
    float u, w;         ///< a point of the plane
    float q, q_u, q_w;  ///< 1 / X there, and its slopes
    float height_m;     ///< distance of the sensor from the plane
    Interval range_m;   ///< range of the surface

    /// At corners q is at least this share of `q`: next to the slice a plane may run to infinity,
    /// but its triangle does not.
    static constexpr float min_q_share = 1e-3F;

    float middle_low() const { return 0.5F * (low.low + high.low); }
    float middle_high() const { return 0.5F * (low.high + high.high); }

    /// The low end of the low side and of the high side, the high end of the high side and of the
    /// low side.
    QuadPoints corners() const {
        return points({low.u, high.u, high.u, low.u}, {low.low, high.low, high.high, low.high});
    }

    /// The points of the plane in four directions.
    QuadPoints points(Eigen::Array4f at_u, const Eigen::Array4f& at_w) const {
        if (widens) at_u *= (1.0F + at_w * at_w).sqrt();
        const Eigen::Array4f secant = (1.0F + at_u * at_u + at_w * at_w).sqrt();
        const Eigen::Array4f at_q = (q + q_u * (at_u - u) + q_w * (at_w - w)).max(min_q_share * q);
        QuadPoints p;
        p.range = (secant / at_q).max(range_m.from).min(range_m.to);
        p.X = p.range / secant;
        p.U = at_u * p.X;
        p.W = at_w * p.X;
        p.u = at_u;
        p.w = at_w;
        return p;
    }
};

}  // namespace sonarsim
