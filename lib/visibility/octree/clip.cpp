#include "visibility/octree/clip.h"

#include <Eigen/Geometry>

namespace sonarsim {

namespace {

/// Keeps the part of a polygon with x[axis] >= bound, or the part with x[axis] < bound.
void cut(const Polygon& from, int axis, double bound, bool keep_above, Polygon& to) {
    to.corners = 0;
    for (int i = 0; i < from.corners; ++i) {
        const Eigen::Vector3d& a = from.corner[i];
        const Eigen::Vector3d& b = from.corner[i + 1 < from.corners ? i + 1 : 0];
        const bool a_in = (a[axis] >= bound) == keep_above;
        const bool b_in = (b[axis] >= bound) == keep_above;
        if (a_in) to.corner[to.corners++] = a;
        if (a_in != b_in) {
            const double t = (bound - a[axis]) / (b[axis] - a[axis]);
            to.corner[to.corners] = a + t * (b - a);
            to.corner[to.corners++][axis] = bound;
        }
    }
    if (to.corners < 3) to.corners = 0;
}

}  // namespace

Polygon clip(const Triangle& triangle, const Cube& cube) {
    Polygon polygon;
    for (int i = 0; i < 3; ++i)
        polygon.corner[i] = triangle[i];
    polygon.corners = 3;
    Polygon next;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = cube.min[axis];
        const double high = low + cube.edge;
        const double least = std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        const double most = std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        if (least < low) {
            cut(polygon, axis, low, true, next);
            std::swap(polygon, next);
        }
        if (most >= high) {
            cut(polygon, axis, high, false, next);
            std::swap(polygon, next);
        }
    }
    return polygon;
}

Moments moments(const Polygon& polygon, const Eigen::Vector3d& relative_to) {
    Moments sum;
    if (polygon.corners < 3) return sum;
    const Eigen::Vector3d a = polygon.corner[0] - relative_to;
    for (int i = 1; i + 1 < polygon.corners; ++i) {
        const Eigen::Vector3d b = polygon.corner[i] - relative_to;
        const Eigen::Vector3d c = polygon.corner[i + 1] - relative_to;
        const double area = 0.5 * (b - a).cross(c - a).norm();
        const Eigen::Vector3d s = a + b + c;
        sum.area += area;
        sum.first += (area / 3.0) * s;
        sum.second += (area / 12.0) * (a * a.transpose() + b * b.transpose() + c * c.transpose() +
                                       s * s.transpose());
    }
    return sum;
}

}  // namespace sonarsim
