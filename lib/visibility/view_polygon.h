#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace sonarsim {

/// A convex part of the view: planes through the sonar, given by normals that point inwards.
using ConvexView = std::span<const Eigen::Vector3f>;

/// A triangle of the sensor frame that up to `max_planes` planes have cut.
struct ViewPolygon {
    static constexpr int max_planes = 32;

    std::array<Eigen::Vector3f, 3 + max_planes> corner;
    int corners = 0;
};

/// Least and greatest distance from the sonar, m; least > greatest if it is empty.
struct RangeInterval {
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();

    void include(float range_m) {
        least = std::min(least, range_m);
        greatest = std::max(greatest, range_m);
    }
};

/// Keeps the part of a polygon on the inner side of a plane through the sonar.
inline void cut(const ViewPolygon& from, const Eigen::Vector3f& inwards, ViewPolygon& to) {
    to.corners = 0;
    const Eigen::Vector3f* a = &from.corner[from.corners - 1];
    float height_a = inwards.dot(*a);
    for (int i = 0; i < from.corners; ++i) {
        const Eigen::Vector3f* b = &from.corner[i];
        const float height_b = inwards.dot(*b);
        if ((height_a >= 0.0F) != (height_b >= 0.0F))
            to.corner[to.corners++] = *a + height_a / (height_a - height_b) * (*b - *a);
        if (height_b >= 0.0F) to.corner[to.corners++] = *b;
        a = b;
        height_a = height_b;
    }
}

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
        cut(polygons[now], inwards, polygons[1 - now]);
        now = 1 - now;
        if (polygons[now].corners == 0) return {};
    }
    return ranges_of(polygons[now], normal);
}

}  // namespace sonarsim
