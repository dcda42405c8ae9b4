#include "visibility/slices/parallelogram.h"

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
float area_of(const Quad& quad, const QuadPoints& c, float nearest_m, float farthest_m) {
    const float picture =
        std::fabs((c.u[2] - c.u[0]) * (c.w[3] - c.w[1]) - (c.u[3] - c.u[1]) * (c.w[2] - c.w[0]));
    const Eigen::Array4f X3 = c.X * c.X * c.X;
    const bool moved = nearest_m <= quad.range_m.from || farthest_m >= quad.range_m.to;
    const float mean_X3 = 0.25F * ((X3[0] + X3[2]) + (X3[1] + X3[3]));
    const float in_picture = 0.5F * picture * (moved ? mean_X3 : X3.maxCoeff()) / quad.height_m;
    const float in_space = 0.5F * (c.at(2) - c.at(0)).cross(c.at(3) - c.at(1)).norm();
    return moved ? in_picture : std::min(in_space, area_rounding * in_picture);
}

/// The centroid of a trapezoid lies towards its wide end.
Eigen::Vector3f centroid_of(const QuadPoints& corners) {
    const Eigen::Vector3f a = corners.at(0), b = corners.at(1);
    const Eigen::Vector3f c = corners.at(2), d = corners.at(3);
    const float one = (b - a).cross(c - a).norm();
    const float other = (c - a).cross(d - a).norm();
    // Both areas vanish if the patch is as narrow as rounding.
    if (!(one + other > 0.0F)) return 0.25F * (a + b + c + d);
    return 1.0F / (3.0F * (one + other)) * (one * (a + b + c) + other * (a + c + d));
}

/// Fits a parallelogram to the ranges of its corners, so that it fills the bins that the surface
/// fills, and no others. The deeper edge is lengthened or shortened, and the parallelogram is moved
/// along it, each by at most half of that edge.
void fit_range(float nearest_m, float farthest_m, Parallelogram& out) {
    const float r = out.position.norm();
    const float u = out.position.dot(out.edge_u) / r;
    const float v = out.position.dot(out.edge_v) / r;
    const float depth_u = std::fabs(u);
    const float depth_v = std::fabs(v);
    const float bend_u = out.edge_u.squaredNorm() - depth_u * depth_u;
    const float bend_v = out.edge_v.squaredNorm() - depth_v * depth_v;
    const float bend = (bend_u + bend_v) / (2.0F * r);
    const float deeper = std::max(depth_u, depth_v);
    // If the foot of the perpendicular lies on the patch, the corners do not give the least range.
    // Along an edge e with t in [-1, 1] the range is r + (u t + (e^2 - u^2) t^2 / 2 r): it has no
    // minimum inside if |u| > (e^2 - u^2) / r, twice the bend. Four times the bend allows for both
    // edges.
    if (!(deeper > 4.0F * bend)) return;
    const float limit = 0.5F * deeper;
    const float more = 0.5F * (farthest_m - nearest_m) - depth_u - depth_v;
    const float shift = 0.5F * (farthest_m + nearest_m) - r - bend;
    const bool by_u = depth_u > depth_v;
    const float move = std::clamp(shift, -limit, limit) / (by_u ? u : v);
    const float stretch = 1.0F + std::clamp(more, -limit, limit) / deeper;
    // No branches, since either edge is as likely.
    for (int k = 0; k < 3; ++k)
        out.position[k] += move * (by_u ? out.edge_u[k] : out.edge_v[k]);
    out.edge_u *= by_u ? stretch : 1.0F;
    out.edge_v *= by_u ? 1.0F : stretch;
}

}  // namespace

Parallelogram fit_parallelogram(const Quad& quad, const QuadPoints& corners,
                                const Eigen::Matrix3f& R_sensor_frame, bool centroid) {
    const float nearest_m = corners.range.minCoeff();
    const float farthest_m = corners.range.maxCoeff();
    const Eigen::Vector3f a = corners.at(0), b = corners.at(1);
    const Eigen::Vector3f c = corners.at(2), d = corners.at(3);
    Parallelogram out;
    out.position = R_sensor_frame *
                   (centroid ? centroid_of(corners) : Eigen::Vector3f(0.25F * (a + b + c + d)));
    out.edge_u = R_sensor_frame * (0.25F * (b + c - a - d));
    out.edge_v = R_sensor_frame * (0.25F * (c + d - a - b));
    out.area_m2 = area_of(quad, corners, nearest_m, farthest_m);
    fit_range(nearest_m, farthest_m, out);
    return out;
}

}  // namespace sonarsim
