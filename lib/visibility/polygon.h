#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace sonarsim {

/// A convex, planar polygon: a triangle that up to `most_cuts` planes have cut.
template <class Real, int most_cuts>
struct Polygon {
    using Corner = Eigen::Matrix<Real, 3, 1>;

    std::array<Corner, 3 + most_cuts> corner;
    int corners = 0;
};

/// Keeps the part of a polygon where height(corner), the distance from a plane, is not negative.
template <class Cut, class Height>
void cut(const Cut& from, const Height& height, Cut& to) {
    to.corners = 0;
    if (from.corners == 0) return;
    const typename Cut::Corner* a = &from.corner[from.corners - 1];
    auto height_a = height(*a);
    for (int i = 0; i < from.corners; ++i) {
        const typename Cut::Corner* b = &from.corner[i];
        const auto height_b = height(*b);
        if ((height_a >= 0) != (height_b >= 0))
            to.corner[to.corners++] = *a + height_a / (height_a - height_b) * (*b - *a);
        if (height_b >= 0) to.corner[to.corners++] = *b;
        a = b;
        height_a = height_b;
    }
    if (to.corners < 3) to.corners = 0;
}

/// A convex part of the view: planes through the sonar, given by normals that point inwards.
using ConvexView = std::span<const Eigen::Vector3f>;

inline constexpr int most_view_planes = 32;
using ViewPolygon = Polygon<float, most_view_planes>;

/// Least and greatest distance from the sonar, m; least > greatest if it is empty.
struct RangeInterval {
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();

    void include(float range_m) {
        least = std::min(least, range_m);
        greatest = std::max(greatest, range_m);
    }
};

/// The interval of distances of a convex, planar polygon.
inline RangeInterval ranges_of(const ViewPolygon& polygon, const Eigen::Vector3f& normal) {
    RangeInterval ranges;
    const float square = normal.squaredNorm();
    const Eigen::Vector3f foot =
        square > 0.0F ? Eigen::Vector3f(normal * (normal.dot(polygon.corner[0]) / square))
                      : Eigen::Vector3f::Zero();
    bool left = square > 0.0F;  // the foot of the sonar's perpendicular is to the left of all edges
    bool right = left;
    const Eigen::Vector3f* a = &polygon.corner[polygon.corners - 1];
    for (int i = 0; i < polygon.corners; ++i) {
        const Eigen::Vector3f* b = &polygon.corner[i];
        const Eigen::Vector3f edge = *b - *a;
        const float length2 = edge.squaredNorm();
        ranges.include(b->norm());
        const float along = -a->dot(edge);
        if (along > 0.0F && along < length2) ranges.include((*a + along / length2 * edge).norm());
        const float side = normal.dot(edge.cross(foot - *a));
        left = left && side >= 0.0F;
        right = right && side <= 0.0F;
        a = b;
    }
    if (left != right) ranges.include(foot.norm());
    return ranges;
}

/// The interval of distances of the part of a triangle inside a convex view.
inline RangeInterval ranges_within(const std::array<Eigen::Vector3f, 3>& triangle,
                                   const Eigen::Vector3f& normal, ConvexView view) {
    ViewPolygon polygons[2];
    std::copy(triangle.begin(), triangle.end(), polygons[0].corner.begin());
    polygons[0].corners = 3;
    int now = 0;
    for (const Eigen::Vector3f& inwards : view) {
        cut(
            polygons[now], [&](const Eigen::Vector3f& p) { return inwards.dot(p); },
            polygons[1 - now]);
        now = 1 - now;
        if (polygons[now].corners == 0) return {};
    }
    return ranges_of(polygons[now], normal);
}

}  // namespace sonarsim
