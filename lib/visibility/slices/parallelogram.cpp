#include "visibility/slices/parallelogram.h"

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

/// The corners of a batch, and the limits of the range.
struct Corners8 {
    struct Corner {
        Vectors8 at;
        Floats8 range;
        Floats8 u, w;  ///< direction
    };

    std::array<Corner, 4> corners;
    Floats8 nearest_m, farthest_m, height_m;

    explicit Corners8(const QuadBatch& batch)
        : nearest_m(Floats8::load(batch.nearest_m.data())),
          farthest_m(Floats8::load(batch.farthest_m.data())),
          height_m(Floats8::load(batch.height_m.data())) {
        // In the order of the members of QuadPoints, four numbers each.
        constexpr int stride = 24;
        static_assert(sizeof(QuadPoints) == stride * sizeof(float));
        const float* const numbers = batch.corners[0].X.data();
        const std::array<Floats8, lanes> XU = columns_of_eight(numbers, stride);
        const std::array<Floats8, lanes> Wr = columns_of_eight(numbers + lanes, stride);
        const std::array<Floats8, lanes> uw = columns_of_eight(numbers + 2 * lanes, stride);
        for (int k = 0; k < 4; ++k)
            corners[k] = {{XU[k], XU[k + 4], Wr[k]}, Wr[k + 4], uw[k], uw[k + 4]};
    }

    Floats8 nearest() const {
        const auto& [a, b, c, d] = corners;
        return least(least(a.range, b.range), least(c.range, d.range));
    }
    Floats8 farthest() const {
        const auto& [a, b, c, d] = corners;
        return greatest(greatest(a.range, b.range), greatest(c.range, d.range));
    }
};

/// The areas of quadrilaterals, m^2. On a plane dA = X^3 du dw / h. The range of a corner is
/// limited to that of its surface. Where the plane reaches beyond this range, the limit moves
/// corners off the plane. Moved corners span less than the visible area, or, if the surface is
/// nearly edge-on and two u are nearly equal, an area along the line of sight that does not exist:
/// up to hundreds of times that of the triangle. So the area between moved corners is computed from
/// their picture.
Floats8 areas(const Corners8& quads) {
    const auto& [a, b, c, d] = quads.corners;
    const auto cube = [](Floats8 x) { return x * x * x; };
    const Floats8 picture = absolute((c.u - a.u) * (d.w - b.w) - (d.u - b.u) * (c.w - a.w));
    const auto area_at = [&](Floats8 X3) { return 0.5F * picture * X3 / quads.height_m; };
    const Floats8 most_X = greatest(greatest(a.at.x, b.at.x), greatest(c.at.x, d.at.x));
    const Floats8 mean_X3 = 0.25F * ((cube(a.at.x) + cube(c.at.x)) + (cube(b.at.x) + cube(d.at.x)));
    const Floats8 area = 0.5F * norm(cross(c.at - a.at, d.at - b.at));
    const Mask8 moved =
        (quads.nearest() <= quads.nearest_m) | (quads.farthest() >= quads.farthest_m);
    return where(moved, area_at(mean_X3), least(area, area_rounding * area_at(cube(most_X))));
}

/// The centroid of a trapezoid lies towards its wide end.
Vectors8 centroids(const Corners8& quads, const Vectors8& middle) {
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
void fit_range(const Corners8& quads, Parallelograms& out) {
    const Floats8 r = norm(out.position);
    const Floats8 u = dot(out.position, out.edge_u) / r;
    const Floats8 v = dot(out.position, out.edge_v) / r;
    const Floats8 depth_u = absolute(u);
    const Floats8 depth_v = absolute(v);
    const Floats8 bend_u = dot(out.edge_u, out.edge_u) - depth_u * depth_u;
    const Floats8 bend_v = dot(out.edge_v, out.edge_v) - depth_v * depth_v;
    const Floats8 bend = (bend_u + bend_v) / (2.0F * r);
    const Floats8 nearest = quads.nearest();
    const Floats8 farthest = quads.farthest();
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

Parallelograms fit_parallelograms(const QuadBatch& batch, const Eigen::Matrix3f& R_sensor_frame,
                                  bool centroid) {
    const Corners8 quads(batch);
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
