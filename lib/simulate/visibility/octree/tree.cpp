#include "simulate/visibility/octree/tree.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// A convex, planar polygon: a triangle after clipping by up to six planes.
struct Polygon {
    std::array<Eigen::Vector3d, 9> corner;
    int corners = 0;
};

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
/// triangle touches the cube: then its area is tiny beside the triangle's.
bool is_real(double part, const Triangle& t) {
    const double whole = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    return whole > 0.0 && part > 1e-6 * whole;
}

/// Surface of one direction and material inside a cube.
struct Group {
    double area;
    Eigen::Vector3d normal;  ///< sum of area times normal
    double largest;          ///< area of the largest polygon
    std::uint32_t triangle;  ///< the triangle of this polygon
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
        groups.push_back({area, area * normal, area, triangle, facet.material});
        return;
    }
    home->area += area;
    // The last group takes all directions, but not opposite normals: the sum is not near 0.
    if (best >= 0.0) home->normal += area * normal;
    if (area > home->largest) {
        home->largest = area;
        home->triangle = triangle;
        home->material = facet.material;
    }
}

constexpr std::size_t triangles_per_tile = 48;
constexpr double leaves_per_tile_edge = 32.0;
constexpr int max_levels = 30;  // a CubeIndex has 31 bits

/// Memory of the leaves, above which tiles out of view are dropped.
constexpr std::size_t max_bytes = std::size_t{512} << 20U;

// Planes of a scene often have round coordinates. If faces of cubes coincided with them, rounding
// would decide which cube holds the surface; these offsets, in units of a leaf, prevent that.
const Eigen::Vector3d lattice_offset(0.381966011, 0.618033989, 0.272019650);

/// The part of a triangle in a cube, if any. Surface between two cubes belongs to the upper one.
Polygon clip(const Triangle& triangle, const Cube& cube) {
    const auto& [a, b, c] = triangle;
    const Eigen::Array3d lowest = a.cwiseMin(b).cwiseMin(c);
    const Eigen::Array3d highest = a.cwiseMax(b).cwiseMax(c);
    const Eigen::Array3d low = cube.min;
    const Eigen::Array3d high = low + cube.edge;
    if ((highest < low || lowest >= high).any()) return {};
    Polygon polygon{{a, b, c}, 3};
    Polygon next;
    for (int axis = 0; axis < 3; ++axis) {
        if (lowest[axis] < low[axis]) {
            cut(polygon, axis, low[axis], true, next);
            std::swap(polygon, next);
        }
        if (highest[axis] >= high[axis]) {
            cut(polygon, axis, high[axis], false, next);
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

/// The leaf of a cube; nothing if it holds no surface but a millionth of a triangle.
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
    const Group& largest = *std::ranges::max_element(groups, {}, &Group::area);
    return Leaf{largest.normal.normalized().cast<float>(), largest.triangle, 0, 0, 0};
}

}  // namespace

std::string too_small_leaves(double length_m, double leaf_m) {
    if (length_m + 2.0 * leaf_m <= std::ldexp(leaf_m, max_levels)) return "";
    return "octree_leaf_m of " + number_text(leaf_m) + " is too small for a scene " +
           number_text(std::ceil(length_m)) + " m long; use engine: auto or larger leaves";
}

Octree::Octree(const Scene& scene, const Caster& caster, double leaf_m)
    : scene_(scene), caster_(caster), leaf_m_(leaf_m) {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();
    Eigen::Vector3d high = Eigen::Vector3d::Zero();
    if (!scene.vertices.empty()) low = high = scene.vertices[0].cast<double>();
    for (const Eigen::Vector3f& vertex : scene.vertices) {
        low = low.cwiseMin(vertex.cast<double>());
        high = high.cwiseMax(vertex.cast<double>());
    }
    const double length = (high - low).maxCoeff();
    if (const std::string refusal = too_small_leaves(length, leaf_m); !refusal.empty())
        throw InputError(refusal);
    while (std::ldexp(leaf_m, leaf_level_) < length + 2.0 * leaf_m)
        ++leaf_level_;
    edge_m_ = std::ldexp(leaf_m, leaf_level_);
    for (int axis = 0; axis < 3; ++axis)
        min_[axis] = low[axis] - lattice_offset[axis] * leaf_m;
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    add_node({}, std::move(all));
}

Cube Octree::cube(const CubeIndex& index) const {
    const double edge = std::ldexp(edge_m_, -index.level);
    return {min_ + edge * Eigen::Vector3d(index.x, index.y, index.z), edge};
}

std::vector<std::uint32_t> Octree::inside(const std::vector<std::uint32_t>& triangles,
                                          const Cube& cube) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t index : triangles) {
        if (clip(triangle_of(scene_, index), cube).corners > 0) found.push_back(index);
    }
    found.shrink_to_fit();
    return found;
}

Octree::Node* Octree::add_node(const CubeIndex& index, std::vector<std::uint32_t> triangles) {
    Node& node = nodes_.emplace_back();
    node.index = index;
    const double edge_leaves = cube(index).edge / leaf_m_;
    const bool few = triangles.size() <= triangles_per_tile;
    // A tile holds many tiny triangles, so that the upper part does not grow forever.
    node.is_tile = (edge_leaves <= leaves_per_tile_edge && few) || edge_leaves <= 2.0;
    node.triangles = std::move(triangles);
    return &node;
}

void Octree::split(Node& node) {
    const std::vector<std::uint32_t> triangles = std::exchange(node.triangles, {});
    node.is_split = true;
    for (int octant = 0; octant < 8; ++octant) {
        const CubeIndex child = node.index.child(octant);
        std::vector<std::uint32_t> own = inside(triangles, cube(child));
        if (!own.empty()) node.children[octant] = add_node(child, std::move(own));
    }
}

void Octree::add_leaves(const CubeIndex& tile, const CubeIndex& at,
                        const std::vector<std::uint32_t>& triangles,
                        std::vector<Leaf>& leaves) const {
    if (triangles.empty()) return;
    const int depth = leaf_level_ - tile.level;
    if (at.level == leaf_level_) {
        auto leaf = leaf_of(cube(at), triangles, scene_, caster_);
        if (!leaf) return;
        leaf->x = static_cast<std::uint16_t>(at.x - (tile.x << depth));
        leaf->y = static_cast<std::uint16_t>(at.y - (tile.y << depth));
        leaf->z = static_cast<std::uint16_t>(at.z - (tile.z << depth));
        leaves.push_back(*leaf);
        return;
    }
    for (int octant = 0; octant < 8; ++octant) {
        const CubeIndex child = at.child(octant);
        add_leaves(tile, child, inside(triangles, cube(child)), leaves);
    }
}

void Octree::find_tiles(Node& node, Containment containment, const ViewVolume& volume,
                        std::vector<TileInView>& tiles) {
    const Cube own = cube(node.index);
    const Eigen::Vector3d middle = own.min.array() + 0.5 * own.edge;
    const Eigen::Vector3f centre = (middle - volume.position()).cast<float>();
    const auto edge = static_cast<float>(own.edge);
    if (containment != Containment::inside) containment = volume.contains_cube(centre, edge);
    if (containment == Containment::outside) return;
    if (node.is_tile) {
        node.last_use = pings_;
        if (!node.leaves) {
            std::vector<Leaf> leaves;
            add_leaves(node.index, node.index, node.triangles, leaves);
            leaves.shrink_to_fit();
            bytes_ += leaves.size() * sizeof(Leaf);
            node.leaves = std::make_shared<const std::vector<Leaf>>(std::move(leaves));
        }
        tiles.push_back({centre.array() - 0.5F * edge, containment, node.leaves});
        return;
    }
    if (!node.is_split) split(node);
    const int near = (centre.x() < 0.0F) | (centre.y() < 0.0F) << 1 | (centre.z() < 0.0F) << 2;
    for (int i = 0; i < 8; ++i) {
        if (Node* const child = node.children[i ^ near])
            find_tiles(*child, containment, volume, tiles);
    }
}

std::vector<TileInView> Octree::tiles_in_view(const ViewVolume& volume) {
    const std::scoped_lock alone(growing_);
    ++pings_;
    std::vector<TileInView> tiles;
    find_tiles(nodes_[0], Containment::partly, volume, tiles);
    if (bytes_ <= max_bytes) return tiles;
    for (Node& node : nodes_) {
        if (!node.leaves || node.last_use == pings_) continue;
        bytes_ -= node.leaves->size() * sizeof(Leaf);
        node.leaves.reset();
    }
    return tiles;
}

}  // namespace sonarsim
