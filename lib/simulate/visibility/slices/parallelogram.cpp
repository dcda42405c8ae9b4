#include "simulate/visibility/slices/parallelogram.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// Rounding margin for the area of a quadrilateral that is narrow in the picture.
constexpr float area_rounding = 1.01F;

/// The area of a quadrilateral, m^2. On a plane dA = X^3 du dw / h. The range of a corner is
/// limited to that of its surface. Where the plane reaches beyond this range, the limit moves
/// corners off the plane. Moved corners span less than the visible area, or, if the surface is
/// nearly edge-on and two u are nearly equal, an area along the line of sight that does not exist:
/// up to hundreds of times that of the triangle. So the area between moved corners is computed from
/// their picture.
float area_of(const Quad& quad, const QuadPoints& p) {
    const float picture =
        std::fabs((p.u[2] - p.u[0]) * (p.w[3] - p.w[1]) - (p.u[3] - p.u[1]) * (p.w[2] - p.w[0]));
    const auto area_at = [&](float X3) { return 0.5F * picture * X3 / quad.height_m; };
    const Eigen::Array4f X3 = p.X * p.X * p.X;
    if (p.range.minCoeff() <= quad.range_m.from || p.range.maxCoeff() >= quad.range_m.to)
        return area_at(0.25F * ((X3[0] + X3[2]) + (X3[1] + X3[3])));
    const float area = 0.5F * (p.at(2) - p.at(0)).cross(p.at(3) - p.at(1)).norm();
    return std::min(area, area_rounding * area_at(X3.maxCoeff()));
}

/// The centroid of a trapezoid lies towards its wide end.
Eigen::Vector3f centroid_of(const QuadPoints& p) {
    const Eigen::Vector3f across = p.at(2) - p.at(0);
    const float one = (p.at(1) - p.at(0)).cross(across).norm();
    const float other = across.cross(p.at(3) - p.at(0)).norm();
    // Both areas vanish if the patch is as narrow as rounding.
    if (!(one + other > 0.0F)) return 0.25F * (p.at(0) + p.at(1) + p.at(2) + p.at(3));
    return 1.0F / (3.0F * (one + other)) *
           (one * (p.at(0) + p.at(1) + p.at(2)) + other * (p.at(0) + p.at(2) + p.at(3)));
}

/// Fits a parallelogram to the ranges of the corners, so that it fills the bins that the surface
/// fills, and no others. The deeper edge is lengthened or shortened, and the parallelogram is moved
/// along it, each by at most half of that edge.
void fit_range(const QuadPoints& corners, Parallelogram& out) {
    const float r = out.position.norm();
    const float u = out.position.dot(out.edge_u) / r;
    const float v = out.position.dot(out.edge_v) / r;
    const float depth_u = std::fabs(u);
    const float depth_v = std::fabs(v);
    const float bend_u = out.edge_u.squaredNorm() - depth_u * depth_u;
    const float bend_v = out.edge_v.squaredNorm() - depth_v * depth_v;
    const float bend = (bend_u + bend_v) / (2.0F * r);
    const bool by_u = depth_u > depth_v;
    const float deeper = by_u ? depth_u : depth_v;
    // If the foot of the perpendicular lies on the patch, the corners do not give the least range.
    // Along an edge e with t in [-1, 1] the range is r + (u t + (e^2 - u^2) t^2 / 2 r): it has no
    // minimum inside if |u| > (e^2 - u^2) / r, twice the bend. Four times the bend allows for both
    // edges.
    if (!(deeper > 4.0F * bend)) return;
    const float nearest = corners.range.minCoeff();
    const float farthest = corners.range.maxCoeff();
    const float limit = 0.5F * deeper;
    const auto limited = [&](float x) { return std::clamp(x, -limit, limit); };
    const float shift = limited(0.5F * (farthest + nearest) - r - bend);
    const float more = limited(0.5F * (farthest - nearest) - depth_u - depth_v);
    Eigen::Vector3f& edge = by_u ? out.edge_u : out.edge_v;
    out.position += shift / (by_u ? u : v) * edge;
    edge *= 1.0F + more / deeper;
}

}  // namespace

Parallelogram fit_parallelogram(const Quad& quad, const QuadPoints& corners,
                                const Eigen::Matrix3f& R_sensor_frame, bool centroid) {
    const Eigen::Vector3f a = corners.at(0);
    const Eigen::Vector3f b = corners.at(1);
    const Eigen::Vector3f c = corners.at(2);
    const Eigen::Vector3f d = corners.at(3);
    const Eigen::Vector3f middle = centroid ? centroid_of(corners) : 0.25F * (a + b + c + d);
    Parallelogram out{R_sensor_frame * middle, R_sensor_frame * (0.25F * (b + c - a - d)),
                      R_sensor_frame * (0.25F * (c + d - a - b)), area_of(quad, corners)};
    fit_range(corners, out);
    return out;
}

}  // namespace sonarsim
