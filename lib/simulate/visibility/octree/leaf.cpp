#include "simulate/visibility/octree/leaf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

namespace sonarsim {

namespace {

constexpr std::size_t max_groups = 6;
constexpr double same_direction = 0.85;  // cosine

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

/// True if the part of a triangle in a cube is real surface, false if it is rounding where the
/// triangle touches the cube: then its area is tiny compared to the triangle. All area of a
/// triangle without area is rounding.
bool is_real(double part, const Triangle& t) {
    const double whole = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    return whole > 0.0 && part > 1e-6 * whole;
}

/// Surface of one direction and material inside a cube.
struct Group {
    double area;
    Eigen::Vector3d normal;  ///< sum of area times normal
    double largest;          ///< area of the largest polygon
    Leaf leaf;
    std::uint32_t material;
};

void add_to_groups(double area, const Facet& facet, std::uint32_t triangle,
                   std::vector<Group>& groups) {
    const Eigen::Vector3d normal = facet.normal.cast<double>();
    Group* home = nullptr;
    double best = -2.0;
    for (Group& group : groups) {
        double alike = group.normal.dot(normal) / group.normal.norm();
        if (group.material != facet.material) alike -= 1.0;
        if (alike > best) {
            best = alike;
            home = &group;
        }
    }
    if (!home || (best < same_direction && groups.size() < max_groups)) {
        groups.push_back(
            {area, area * normal, area, {Eigen::Vector3f::Zero(), triangle}, facet.material});
        return;
    }
    home->area += area;
    // The last group takes all directions. Opposite normals are not added, so that the sum stays
    // away from zero.
    if (best >= 0.0) home->normal += area * normal;
    if (area > home->largest) {
        home->largest = area;
        home->leaf.triangle = triangle;
        home->material = facet.material;
    }
}

}  // namespace

bool overlaps(const Triangle& triangle, const Cube& cube) {
    for (int axis = 0; axis < 3; ++axis) {
        const double low = std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        const double high = std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        if (high < cube.min[axis] || low >= cube.min[axis] + cube.edge) return false;
    }
    return true;
}

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

double area_m2(const Polygon& polygon) {
    double sum = 0.0;
    for (int i = 1; i + 1 < polygon.corners; ++i) {
        sum += 0.5 * (polygon.corner[i] - polygon.corner[0])
                         .cross(polygon.corner[i + 1] - polygon.corner[0])
                         .norm();
    }
    return sum;
}

Triangle triangle_of(const Scene& scene, std::uint32_t index) {
    const auto& [a, b, c] = scene.triangles[index];
    return {scene.vertices[a].cast<double>(), scene.vertices[b].cast<double>(),
            scene.vertices[c].cast<double>()};
}

std::optional<Leaf> leaf_of(const Cube& cube, std::span<const std::uint32_t> triangles,
                            const Scene& scene, const Caster& caster) {
    const double sliver = 1e-12 * cube.edge * cube.edge;
    std::vector<Group> groups;
    for (const std::uint32_t index : triangles) {
        const Triangle whole = triangle_of(scene, index);
        const double area = area_m2(clip(whole, cube));
        if (area > sliver || (area > 0.0 && is_real(area, whole)))
            add_to_groups(area, caster.facet(index), index, groups);
    }
    if (groups.empty()) return std::nullopt;
    Group& largest = *std::ranges::max_element(groups, {}, &Group::area);
    largest.leaf.normal = largest.normal.normalized().cast<float>();
    return largest.leaf;
}

}  // namespace sonarsim
