#include "visibility/slices/patch_corners.h"

#include <cstddef>

namespace sonarsim {

namespace {

// Rounding margin for the area of a quadrilateral that is narrow in the picture.
constexpr float area_rounding = 1.01F;

Vectors8 operator+(const Vectors8& a, const Vectors8& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vectors8 operator-(const Vectors8& a, const Vectors8& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vectors8 operator*(Floats8 a, const Vectors8& b) {
    return {a * b.x, a * b.y, a * b.z};
}
Vectors8 where(Mask8 mask, const Vectors8& a, const Vectors8& b) {
    return {where(mask, a.x, b.x), where(mask, a.y, b.y), where(mask, a.z, b.z)};
}
Floats8 dot(const Vectors8& a, const Vectors8& b) {
    return a.x * b.x + (a.y * b.y + a.z * b.z);
}
Vectors8 cross(const Vectors8& a, const Vectors8& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Floats8 norm(const Vectors8& a) {
    return sqrt(dot(a, a));
}
Vectors8 turned(const Eigen::Matrix3f& R, const Vectors8& a) {
    const auto row = [&](int i) { return R(i, 0) * a.x + (R(i, 1) * a.y + R(i, 2) * a.z); };
    return {row(0), row(1), row(2)};
}
/// x, within +-limit.
Floats8 limited(Floats8 x, Floats8 limit) {
    return least(greatest(x, 0.0F - limit), limit);
}

Floats8 nearest_corner(const PatchCorners& quads) {
    const auto& [a, b, c, d] = quads.corners;
    return least(least(a.range, b.range), least(c.range, d.range));
}
Floats8 farthest_corner(const PatchCorners& quads) {
    const auto& [a, b, c, d] = quads.corners;
    return greatest(greatest(a.range, b.range), greatest(c.range, d.range));
}

/// The areas of quadrilaterals, m^2. On a plane dA = X^3 du dw / h. The range of a corner is
/// limited to that of its surface. Where the plane reaches beyond this range, the limit moves
/// corners off the plane. Moved corners span less than the visible area, or, if the surface is
/// nearly edge-on and two u are nearly equal, an area along the line of sight that does not exist:
/// up to hundreds of times that of the triangle. So the area between moved corners is computed from
/// their picture.
Floats8 areas(const PatchCorners& quads) {
    const auto& [a, b, c, d] = quads.corners;
    const auto cube = [](Floats8 x) { return x * x * x; };
    const Floats8 picture = absolute((c.u - a.u) * (d.w - b.w) - (d.u - b.u) * (c.w - a.w));
    const auto area_at = [&](Floats8 X3) { return 0.5F * picture * X3 / quads.height_m; };
    const Floats8 most_X = greatest(greatest(a.at.x, b.at.x), greatest(c.at.x, d.at.x));
    const Floats8 mean_X3 = 0.25F * ((cube(a.at.x) + cube(c.at.x)) + (cube(b.at.x) + cube(d.at.x)));
    const Floats8 area = 0.5F * norm(cross(c.at - a.at, d.at - b.at));
    const Mask8 moved =
        (nearest_corner(quads) <= quads.nearest_m) | (farthest_corner(quads) >= quads.farthest_m);
    return where(moved, area_at(mean_X3), least(area, area_rounding * area_at(cube(most_X))));
}

/// The centroid of a trapezoid lies towards its wide end.
Vectors8 centroids(const PatchCorners& quads, const Vectors8& middle) {
    const auto& [a, b, c, d] = quads.corners;
    const Floats8 one = norm(cross(b.at - a.at, c.at - a.at));
    const Floats8 other = norm(cross(c.at - a.at, d.at - a.at));
    const Floats8 per_weight = 1.0F / (3.0F * (one + other));
    const Vectors8 sum = one * (a.at + b.at + c.at) + other * (a.at + c.at + d.at);
    // Both areas vanish if the patch is as narrow as rounding.
    return where(one + other > 0.0F, per_weight * sum, middle);
}

/// Fits parallelograms to the ranges of their corners, so that they fill the bins that the surface
/// fills, and no others. The deeper edge is lengthened or shortened, and the parallelogram is moved
/// along it, each by at most half of that edge.
void fit_range(const PatchCorners& quads, Parallelograms& out) {
    const Floats8 r = norm(out.position);
    const Floats8 u = dot(out.position, out.edge_u) / r;
    const Floats8 v = dot(out.position, out.edge_v) / r;
    const Floats8 depth_u = absolute(u);
    const Floats8 depth_v = absolute(v);
    const Floats8 bend_u = dot(out.edge_u, out.edge_u) - depth_u * depth_u;
    const Floats8 bend_v = dot(out.edge_v, out.edge_v) - depth_v * depth_v;
    const Floats8 bend = (bend_u + bend_v) / (2.0F * r);
    const Floats8 nearest = nearest_corner(quads);
    const Floats8 farthest = farthest_corner(quads);
    const Floats8 more = 0.5F * (farthest - nearest) - depth_u - depth_v;
    const Floats8 shift = 0.5F * (farthest + nearest) - r - bend;
    const Mask8 by_u = depth_u > depth_v;
    const Floats8 deeper = greatest(depth_u, depth_v);
    const Floats8 limit = 0.5F * deeper;
    // If the foot of the perpendicular lies on the patch, the corners do not give the least range.
    // Along an edge e with t in [-1, 1] the range is r + (u t + (e^2 - u^2) t^2 / 2 r): it has no
    // minimum inside if |u| > (e^2 - u^2) / r, twice the bend. Four times the bend allows for both
    // edges.
    const Mask8 fits = deeper > 4.0F * bend;
    const Floats8 move = where(fits, limited(shift, limit) / where(by_u, u, v));
    const Floats8 stretch = where(fits, 1.0F + limited(more, limit) / deeper, 1.0F);
    out.position = out.position + move * where(by_u, out.edge_u, out.edge_v);
    out.edge_u = where(by_u, stretch, 1.0F) * out.edge_u;
    out.edge_v = where(by_u, 1.0F, stretch) * out.edge_v;
}

}  // namespace

PatchCorners corners_of(const std::array<Quad, lanes>& quads) {
    static_assert(sizeof(Quad) == 64 && offsetof(Quad, low) == 8 && offsetof(Quad, u) == 32 &&
                  offsetof(Quad, height_m) == 52);
    const auto* const numbers = reinterpret_cast<const float*>(quads.data());
    // In the order of Quad's members; the first two of its numbers are not floats.
    const std::array<Floats8, lanes> sides = columns_of_eight(numbers, 16);
    const std::array<Floats8, lanes> plane = columns_of_eight(numbers + lanes, 16);
    const Floats8 u = plane[0], w = plane[1];
    const Floats8 q = plane[2], q_u = plane[3], q_w = plane[4];
    const Floats8 height_m = plane[5], nearest_m = plane[6], farthest_m = plane[7];
    const bool all_widen = quads[0].widens;
    const auto corner = [&](Floats8 at_u, Floats8 at_w) -> PatchCorners::Corner {
        if (all_widen) at_u = at_u * sqrt(1.0F + at_w * at_w);
        const Floats8 secant = sqrt(1.0F + at_u * at_u + at_w * at_w);
        const Floats8 at_q =
            greatest(q + q_u * (at_u - u) + q_w * (at_w - w), Quad::least_q_share * q);
        const Floats8 range = least(greatest(secant / at_q, nearest_m), farthest_m);
        const Floats8 X = range / secant;
        return {{X, at_u * X, at_w * X}, range, at_u, at_w};
    };
    const Floats8 low_u = sides[2], high_u = sides[5];
    return {{corner(low_u, sides[3]), corner(high_u, sides[6]), corner(high_u, sides[7]),
             corner(low_u, sides[4])},
            nearest_m,
            farthest_m,
            height_m};
}

Parallelograms fit_parallelograms(const PatchCorners& quads, const Eigen::Matrix3f& R_sensor_frame,
                                  bool centroid) {
    const auto& [a, b, c, d] = quads.corners;
    Vectors8 middle = 0.25F * (a.at + b.at + c.at + d.at);
    if (centroid) middle = centroids(quads, middle);
    Parallelograms out;
    out.position = turned(R_sensor_frame, middle);
    out.edge_u = turned(R_sensor_frame, 0.25F * (b.at + c.at - a.at - d.at));
    out.edge_v = turned(R_sensor_frame, 0.25F * (c.at + d.at - a.at - b.at));
    out.area_m2 = areas(quads);
    fit_range(quads, out);
    return out;
}

}  // namespace sonarsim
