#include "visibility/octree/tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace sonarsim {

namespace {

constexpr std::size_t triangles_per_tile = 48;
constexpr double leaves_per_tile_edge = 32.0;
constexpr double auto_tile_edge_m = 2.0;
constexpr double auto_leaves_per_tile = 200.0;

/// Largest ratio of a flat node's size to the leaves of its level, as a power of 2.
constexpr int flat_levels = 1;

// Planes of a scene often have round coordinates. If faces of cubes coincided with them, rounding
// would decide which cube holds the surface; these offsets, in units of a leaf, prevent that.
const Eigen::Vector3d lattice_offset(0.381966011, 0.618033989, 0.272019650);

bool overlaps(const Triangle& triangle, const Cube& cube) {
    for (int axis = 0; axis < 3; ++axis) {
        const double low = std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        const double high = std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        if (high < cube.min[axis] || low >= cube.min[axis] + cube.edge) return false;
    }
    return true;
}

std::size_t bytes_of(const TopNode& node) {
    const std::size_t triangles =
        node.triangles.capacity() + (node.tile ? node.tile->triangles.capacity() : 0);
    return sizeof(TopNode) + node.level.bytes() + triangles * sizeof(std::uint32_t) +
           (node.tile ? sizeof(Tile) : 0);
}

/// Adds the sentinel and frees spare memory.
void close(Level& level) {
    LevelNode end{};
    end.facets = level.facets.size();
    level.nodes.push_back(end);
    level.nodes.shrink_to_fit();
    level.facets.shrink_to_fit();
}

}  // namespace

Octree::Octree(const Scene& scene, const Caster& caster, const OctreeOptions& options)
    : maker_(scene, caster),
      flat_levels_(options.literal ? 0 : flat_levels),
      cache_(options.memory_mb << 20) {
    if (!(options.leaf_m >= 0.0)) {
        throw InputError("octree: leaf_m must be positive, or 0 for a size that suits the bins");
    }
    Eigen::Vector3d low = Eigen::Vector3d::Zero();
    Eigen::Vector3d high = Eigen::Vector3d::Zero();
    if (!scene.vertices.empty()) low = high = scene.vertices[0].cast<double>();
    for (const Eigen::Vector3f& vertex : scene.vertices) {
        low = low.cwiseMin(vertex.cast<double>());
        high = high.cwiseMax(vertex.cast<double>());
    }
    const double length = (high - low).maxCoeff();
    // A tile has leaves of one size, chosen by its distance, so it must be small compared to the
    // view.
    const double auto_tile_m = length > 0.0 ? std::min(auto_tile_edge_m, 0.25 * length) : 1.0;
    const double leaf = options.leaf_m > 0.0 ? options.leaf_m : auto_tile_m / auto_leaves_per_tile;
    tile_edge_m_ = options.leaf_m > 0.0 ? leaves_per_tile_edge * leaf : auto_tile_m;
    int levels = 0;
    while (std::ldexp(leaf, levels) < length + 2.0 * leaf)
        ++levels;
    if (levels > 30) {
        throw InputError("octree: leaf_m is too small: the scene is " + std::to_string(length) +
                         " m long, more than 2^30 leaves");
    }
    edge_m_ = std::ldexp(leaf, levels);
    for (int axis = 0; axis < 3; ++axis)
        min_[axis] = low[axis] - lattice_offset[axis] * leaf;
    std::vector<std::uint32_t> all(scene.triangles.size());
    for (std::uint32_t i = 0; i < all.size(); ++i)
        all[i] = i;
    add_top({}, std::move(all));
}

double Octree::edge_m(int level) const {
    return std::ldexp(edge_m_, -level);
}

Cube Octree::cube(const CubeIndex& index) const {
    const double edge = edge_m(index.level);
    return {min_ + edge * Eigen::Vector3d(index.x, index.y, index.z), edge};
}

void Octree::add_top(const CubeIndex& index, std::vector<std::uint32_t> triangles) {
    TopNode& node = top_.emplace_back();
    node.index = index;
    if (add_node(index, {}, triangles, node.level)) close(node.level);
    const double edge = edge_m(index.level);
    const bool small = edge <= tile_edge_m_;
    const bool few = triangles.size() <= triangles_per_tile;
    // If triangles are tiny, a tile holds many of them, so that the top does not grow forever.
    if ((small && few) || edge <= tile_edge_m_ / 16.0) {
        node.tile = std::make_unique<Tile>();
        node.tile->index = index;
        node.tile->triangles = std::move(triangles);
    } else {
        node.triangles = std::move(triangles);
    }
    top_bytes_ += bytes_of(node);
}

void Octree::split(std::uint32_t top_node) {
    TopNode& node = top_[top_node];
    std::array<std::vector<std::uint32_t>, 8> lists;
    std::array<Cube, 8> cubes;
    for (int octant = 0; octant < 8; ++octant)
        cubes[octant] = cube(node.index.child(octant));
    for (const std::uint32_t index : node.triangles) {
        const Triangle triangle = maker_.triangle(index);
        for (int octant = 0; octant < 8; ++octant) {
            if (overlaps(triangle, cubes[octant]) && clip(triangle, cubes[octant]).corners > 0)
                lists[octant].push_back(index);
        }
    }
    top_bytes_ -= node.triangles.capacity() * sizeof(std::uint32_t);
    node.triangles = {};
    node.children = static_cast<std::uint32_t>(top_.size());
    for (int octant = 0; octant < 8; ++octant) {
        if (lists[octant].empty()) continue;
        lists[octant].shrink_to_fit();
        node.octants |= static_cast<std::uint8_t>(1 << octant);
        add_top(node.index.child(octant), std::move(lists[octant]));
    }
}

bool Octree::add_node(const CubeIndex& tile, const LevelNode& node,
                      std::span<const std::uint32_t> triangles, Level& level) const {
    const CubeIndex index{(tile.x << node.level) + node.x, (tile.y << node.level) + node.y,
                          (tile.z << node.level) + node.z, tile.level + node.level};
    LevelNode added = node;
    added.facets = level.facets.size();
    const int count = maker_.append(cube(index), triangles, level.facets);
    if (count == 0) return false;
    added.flat = count == 1 && is_flat_rectangle(level.facets.at(added.facets));
    level.nodes.push_back(added);
    return true;
}

void Octree::split(const Tile& tile, const LevelNode& node, Level& finer) const {
    const CubeIndex index{(tile.index.x << node.level) + node.x,
                          (tile.index.y << node.level) + node.y,
                          (tile.index.z << node.level) + node.z, tile.index.level + node.level};
    const Cube parent = cube(index);
    std::vector<std::uint32_t> near;
    for (const std::uint32_t triangle : tile.triangles) {
        if (overlaps(maker_.triangle(triangle), parent)) near.push_back(triangle);
    }
    for (int octant = 0; octant < 8; ++octant) {
        LevelNode child{};
        child.x = static_cast<std::uint16_t>(2 * node.x + (octant & 1));
        child.y = static_cast<std::uint16_t>(2 * node.y + (octant >> 1 & 1));
        child.z = static_cast<std::uint16_t>(2 * node.z + (octant >> 2));
        child.level = static_cast<std::uint8_t>(node.level + 1);
        add_node(tile.index, child, near, finer);
    }
}

void Octree::grow(Tile& tile, int levels) {
    if (tile.levels.empty()) {
        add_node(tile.index, {}, tile.triangles, tile.levels.emplace_back());
        close(tile.levels.back());
    }
    while (static_cast<int>(tile.levels.size()) < levels) {
        const int next = static_cast<int>(tile.levels.size());
        Level finer;
        Level& level = tile.levels.back();
        for (std::size_t i = 0; i + 1 < level.nodes.size(); ++i) {
            LevelNode& node = level.nodes[i];
            node.children = static_cast<std::uint32_t>(finer.nodes.size());
            if (node.flat && next - node.level <= flat_levels_) {
                LevelNode same = node;
                same.facets = finer.facets.size();
                finer.facets.push_back(level.facets.at(node.facets));
                finer.nodes.push_back(same);
            } else {
                split(tile, node, finer);
            }
        }
        level.nodes.back().children = static_cast<std::uint32_t>(finer.nodes.size());
        close(finer);
        tile.levels.push_back(std::move(finer));
    }
    cache_.count(tile);
}

void Octree::note_ping_bytes(std::size_t bytes) {
    std::size_t most = most_ping_bytes_;
    while (bytes > most && !most_ping_bytes_.compare_exchange_weak(most, bytes)) {
    }
}

OctreeStatistics Octree::statistics() const {
    OctreeStatistics out;
    out.bytes = top_bytes_ + cache_.bytes();
    out.ping_bytes = top_bytes_ + most_ping_bytes_;
    out.evictions = cache_.evictions();
    const std::shared_lock top(top_lock_);
    const auto count = [&](const Level& level, bool finest) {
        out.nodes += level.nodes.size() - 1;
        out.facets += level.facets.size();
        if (!finest) return;
        out.leaves += level.nodes.size() - 1;
        for (const float area : level.facets.values[FacetArrays::area])
            out.leaf_area_m2 += static_cast<double>(area);
    };
    for (const TopNode& node : top_) {
        if (node.level.nodes.empty()) continue;
        if (!node.tile) {
            count(node.level, node.children == 0);
            continue;
        }
        const std::shared_lock shared(node.tile->lock);
        if (node.tile->levels.empty()) count(node.level, true);
        for (const Level& level : node.tile->levels)
            count(level, &level == &node.tile->levels.back());
    }
    return out;
}

double longest_octree_scene_m(const OctreeOptions& options) {
    const double leaf =
        options.leaf_m > 0.0 ? options.leaf_m : auto_tile_edge_m / auto_leaves_per_tile;
    return (std::ldexp(1.0, 30) - 2.0) * leaf;
}

}  // namespace sonarsim
