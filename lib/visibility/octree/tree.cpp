#include "visibility/octree/tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

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

std::size_t bytes_of(const Level& level) {
    return sizeof(Level) + level.children.capacity() * sizeof(std::uint32_t) +
           level.nodes.capacity() * sizeof(LevelNode) + level.facets.capacity() * sizeof(LeafFacet);
}

/// Memory of the levels below the tile's own.
std::size_t bytes_of_tile(const Level* finest) {
    std::size_t bytes = 0;
    for (; finest->coarser; finest = finest->coarser.get())
        bytes += bytes_of(*finest);
    return bytes;
}

/// Number of halvings until a node is as small as a leaf at its distance.
int halvings(const Visit& visit, const LeafSize& leaf_size) {
    const float leaf = leaf_size.at(visit.centre.norm()) * 1.0001F;
    int count = 0;
    for (float edge = visit.edge; edge > leaf && visit.index.level + count < 30; edge *= 0.5F)
        ++count;
    return count;
}

}  // namespace

Octree::Octree(const Scene& scene, const Caster& caster, const OctreeOptions& options)
    : maker_(scene, caster),
      flat_levels_(options.literal ? 0 : flat_levels),
      limit_bytes_(options.memory_mb << 20U) {
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
    add_upper({}, std::move(all));
}

Cube Octree::cube(const CubeIndex& index) const {
    const double edge = std::ldexp(edge_m_, -index.level);
    return {min_ + edge * Eigen::Vector3d(index.x, index.y, index.z), edge};
}

void Octree::add_upper(const CubeIndex& index, std::vector<std::uint32_t> triangles) {
    UpperNode& node = upper_.emplace_back();
    node.index = index;
    upper_bytes_ += sizeof(UpperNode) + triangles.capacity() * sizeof(std::uint32_t);
    node.own = level_of_cube(index, triangles);
    node.finest = node.own;
    if (node.own) upper_bytes_ += bytes_of(*node.own);
    const double edge = cube(index).edge;
    const bool small = edge <= tile_edge_m_;
    const bool few = triangles.size() <= triangles_per_tile;
    // If triangles are tiny, a tile holds many of them, so that the upper part does not grow
    // forever.
    node.is_tile = (small && few) || edge <= tile_edge_m_ / 16.0;
    node.triangles = std::move(triangles);
}

void Octree::split(UpperNode& node) {
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
    upper_bytes_ -= node.triangles.capacity() * sizeof(std::uint32_t);
    node.triangles = {};
    node.children = static_cast<std::uint32_t>(upper_.size());
    for (int octant = 0; octant < 8; ++octant) {
        if (lists[octant].empty()) continue;
        lists[octant].shrink_to_fit();
        node.octants |= static_cast<std::uint8_t>(1 << octant);
        add_upper(node.index.child(octant), std::move(lists[octant]));
    }
}

Visit Octree::visit_of(const CubeIndex& index, const ViewVolume& volume) const {
    const Cube own = cube(index);
    const Eigen::Vector3d centre = own.min.array() + 0.5 * own.edge;
    return {index, (centre - volume.position()).cast<float>(), static_cast<float>(own.edge),
            Containment::partly};
}

void Octree::find_tiles(UpperNode& node, Visit visit, PreparedView& prepared) {
    if (!is_in_view(visit, prepared.volume) || !node.own) return;
    const int depth = halvings(visit, prepared.leaf_size);
    if (node.is_tile || depth == 0) {
        node.last_use = pings_;
        prepared.tiles.push_back({visit, &node, std::min(depth, most_levels), nullptr});
        return;
    }
    if (node.children == 0) split(node);
    const int near =
        (visit.centre.x() < 0.0F) | (visit.centre.y() < 0.0F) << 1 | (visit.centre.z() < 0.0F) << 2;
    for (int i = 0; i < 8; ++i) {
        const unsigned octant = i ^ near;
        if (!(node.octants >> octant & 1U)) continue;
        const auto before =
            static_cast<std::uint32_t>(std::popcount(node.octants & ((1U << octant) - 1U)));
        Visit child = visit_of(visit.index.child(static_cast<int>(octant)), prepared.volume);
        child.containment = visit.containment;
        find_tiles(upper_[node.children + before], child, prepared);
    }
}

PreparedView Octree::prepare(const View& view, const Pose& T_local_sensor,
                             const LeafSize& leaf_size) {
    ++pings_;
    PreparedView prepared{view, ViewVolume(view, T_local_sensor), leaf_size};
    find_tiles(upper_[0], visit_of({}, prepared.volume), prepared);
    std::size_t needed = 0;
    bool has_room = true;
    for (TileInView& tile : prepared.tiles) {
        UpperNode& node = *tile.node;
        std::shared_ptr<const Level> level = node.finest;
        if (level->depth < tile.depth) {
            level = grown(node, level, tile.depth);
            const std::size_t more = bytes_of_tile(level.get()) - node.bytes;
            has_room = has_room && make_room(more);
            if (has_room) {
                node.finest = level;
                node.bytes += more;
                tile_bytes_ += more;
            }
        }
        needed += bytes_of_tile(level.get());
        if (node.finest->depth < tile.depth) continue;  // visit_leaves() makes it once more
        while (level->depth > tile.depth)
            level = level->coarser;
        tile.level = std::move(level);
    }
    most_ping_bytes_ = std::max(most_ping_bytes_, needed);
    return prepared;
}

/// Drops tiles that this ping does not need until `bytes` more fit. Leaves a quarter of the limit
/// free, so that the search for the oldest tiles pays. The limit of the tiles is at least a quarter
/// of the whole limit. Returns false if there is no room.
bool Octree::make_room(std::size_t bytes) {
    const std::size_t limit =
        std::max(limit_bytes_ - std::min(upper_bytes_, limit_bytes_), limit_bytes_ / 4);
    if (tile_bytes_ + bytes <= limit) return true;
    std::vector<UpperNode*> oldest_first;
    for (UpperNode& node : upper_) {
        if (node.bytes > 0 && node.last_use < pings_) oldest_first.push_back(&node);
    }
    std::ranges::stable_sort(oldest_first, {}, &UpperNode::last_use);
    for (UpperNode* const node : oldest_first) {
        if (tile_bytes_ + bytes <= limit / 4 * 3) break;
        tile_bytes_ -= std::exchange(node->bytes, 0);
        node->finest = node->own;
        ++evictions_;
    }
    return tile_bytes_ + bytes <= limit;
}

OctreeStatistics Octree::statistics() const {
    OctreeStatistics out;
    out.bytes = upper_bytes_ + tile_bytes_;
    out.ping_bytes = upper_bytes_ + most_ping_bytes_;
    out.evictions = evictions_;
    for (const UpperNode& node : upper_) {
        const bool has_leaves = node.own && node.children == 0;
        for (const Level* level = node.finest.get(); level; level = level->coarser.get()) {
            out.nodes += level->nodes.size() - 1;
            if (!has_leaves || level != node.finest.get()) continue;
            out.leaves += level->nodes.size() - 1;
            for (const LeafFacet& facet : level->facets)
                out.leaf_area_m2 += static_cast<double>(facet.area_m2);
        }
    }
    return out;
}

double longest_octree_scene_m(const OctreeOptions& options) {
    const double leaf =
        options.leaf_m > 0.0 ? options.leaf_m : auto_tile_edge_m / auto_leaves_per_tile;
    return (std::ldexp(1.0, 30) - 2.0) * leaf;
}

}  // namespace sonarsim
