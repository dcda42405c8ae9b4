#include "visibility/octree/leaf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace sonarsim {

namespace {

constexpr int most_facets = 6;
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
    Moments moments;
    Eigen::Vector3d normal;  ///< sum of area times normal
    double largest;          ///< area of the largest polygon
    std::uint32_t triangle;  ///< index of the triangle with the largest polygon
    std::uint32_t material;
};

class FacetGroups {
  public:
    void add(const Moments& moments, const Facet& facet, std::uint32_t triangle) {
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        Group* home = group_.data();
        double best = -2.0;
        for (int i = 0; i < count_; ++i) {
            Group& group = group_[i];
            double alike = group.normal.dot(normal) / group.normal.norm();
            if (group.material != facet.material) alike -= 1.0;
            if (alike > best) {
                best = alike;
                home = &group;
            }
        }
        if (best < same_direction && count_ < most_facets) {
            group_[count_++] = {moments, moments.area * normal, moments.area, triangle,
                                facet.material};
            return;
        }
        home->moments.area += moments.area;
        home->moments.first += moments.first;
        home->moments.second += moments.second;
        // The last group takes all directions. Opposite normals are not added, so that the sum
        // stays away from zero.
        home->normal += moments.area * (best < 0.0 ? Eigen::Vector3d::Zero().eval() : normal);
        if (moments.area > home->largest) {
            home->largest = moments.area;
            home->triangle = triangle;
            home->material = facet.material;
        }
    }

    std::span<Group> by_area() {
        const std::span<Group> groups(group_.data(), count_);
        std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
            return a.moments.area > b.moments.area;
        });
        return groups;
    }

  private:
    std::array<Group, most_facets> group_;
    int count_ = 0;
};

LeafFacet facet_of(const Group& group, const Eigen::Vector3d& relative_to) {
    const Moments& m = group.moments;
    const Eigen::Vector3d centre = m.first / m.area;
    const Eigen::Matrix3d covariance = m.second / m.area - centre * centre.transpose();
    const Eigen::Vector3d n = group.normal.normalized();
    // In-plane axes follow those of the cube where possible: the cube's section by a plane parallel
    // to an axis is a square, whose second moments do not define its rotation.
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    const Eigen::Vector3d p = (Eigen::Vector3d::Unit(axis) - n[axis] * n).normalized();
    const Eigen::Vector3d q = n.cross(p);
    const double pp = p.dot(covariance * p);
    const double qq = q.dot(covariance * q);
    const double pq = p.dot(covariance * q);
    const double mean = 0.5 * (pp + qq);
    const double half = 0.5 * (pp - qq);
    const double split = std::sqrt(half * half + pq * pq);
    Eigen::Vector3d major = p;
    double high = pp;
    double low = qq;
    if (split > 1e-3 * mean) {
        high = mean + split;
        low = mean - split;
        // There are two expressions for the eigenvector; the larger one is more accurate.
        major = half > 0.0 ? ((half + split) * p + pq * q).normalized()
                           : (pq * p + (split - half) * q).normalized();
    }
    const Eigen::Vector3d minor = n.cross(major);
    LeafFacet facet;
    facet.centre = (relative_to + centre).cast<float>();
    facet.normal = n.cast<float>();
    facet.edge_u = (std::sqrt(3.0 * std::max(high, 0.0)) * major).cast<float>();
    facet.edge_v = (std::sqrt(3.0 * std::max(low, 0.0)) * minor).cast<float>();
    facet.area_m2 = static_cast<float>(m.area);
    facet.thickness_m = static_cast<float>(std::sqrt(3.0 * std::max(n.dot(covariance * n), 0.0)));
    facet.triangle = group.triangle;
    return facet;
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

bool is_flat_rectangle(const LeafFacet& facet) {
    const float longest = std::max(facet.edge_u.norm(), facet.edge_v.norm());
    const float rectangle = 4.0F * facet.edge_u.norm() * facet.edge_v.norm();
    return facet.thickness_m < 1e-3F * longest &&
           std::fabs(facet.area_m2 - rectangle) < 1e-3F * rectangle;
}

Triangle LeafMaker::triangle(std::uint32_t index) const {
    const auto& corners = scene_->triangles[index];
    return {scene_->vertices[corners[0]].cast<double>(),
            scene_->vertices[corners[1]].cast<double>(),
            scene_->vertices[corners[2]].cast<double>()};
}

int LeafMaker::append(const Cube& cube, std::span<const std::uint32_t> triangles,
                      std::vector<LeafFacet>& facets) const {
    const Eigen::Vector3d centre = cube.min.array() + 0.5 * cube.edge;
    const double sliver = 1e-12 * cube.edge * cube.edge;
    FacetGroups groups;
    for (const std::uint32_t index : triangles) {
        const Triangle whole = triangle(index);
        const Moments m = moments(clip(whole, cube), centre);
        if (m.area > sliver || (m.area > 0.0 && is_real(m.area, whole))) {
            groups.add(m, caster_->facet(index), index);
        }
    }
    const std::span<Group> found = groups.by_area();
    for (const Group& group : found)
        facets.push_back(facet_of(group, centre));
    return static_cast<int>(found.size());
}

}  // namespace sonarsim
