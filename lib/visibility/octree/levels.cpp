#include <array>
#include <utility>

#include "visibility/octree/tree.h"

namespace sonarsim {

namespace {

CubeIndex index_of(const CubeIndex& tile, const LevelNode& node) {
    return {(tile.x << node.level) + node.x, (tile.y << node.level) + node.y,
            (tile.z << node.level) + node.z, tile.level + node.level};
}

/// Adds the sentinel and frees spare memory.
void close(Level& level) {
    LevelNode end{};
    end.facets = static_cast<std::uint32_t>(level.facets.size());
    level.nodes.push_back(end);
    level.nodes.shrink_to_fit();
    level.facets.shrink_to_fit();
}

/// A node of a tile whose own cube is `root`.
Visit node_visit(const Visit& root, const LevelNode& node) {
    const float edge = root.edge / static_cast<float>(1U << node.level);
    const Eigen::Vector3f at(node.x, node.y, node.z);
    const Eigen::Vector3f corner = root.centre.array() - 0.5F * root.edge;
    return {{}, corner.array() + edge * (at.array() + 0.5F), edge, root.containment};
}

/// The search for the leaves of a tile in view.
struct TileSearch {
    const ViewVolume& volume;
    const TakeLeaf& take;
    Visit root;
    int depth;  ///< the leaves' level
    std::array<const Level*, most_levels + 1> levels{};

    /// Searches the nodes [begin, end) at a depth: the children of one node, or the tile itself.
    void enter(int at, std::uint32_t begin, std::uint32_t end, Containment containment) const {
        const Level& level = *levels[at];
        for (std::uint32_t i = begin; i < end; ++i) {
            Visit visit = node_visit(root, level.nodes[i]);
            visit.containment = containment;
            if (!is_in_view(visit, volume)) continue;
            if (at < depth) {
                const std::vector<std::uint32_t>& children = levels[at + 1]->children;
                enter(at + 1, children[i], children[i + 1], visit.containment);
                continue;
            }
            const std::uint32_t first = level.nodes[i].facets;
            take(visit, root.edge / static_cast<float>(1U << static_cast<unsigned>(depth)),
                 std::span(level.facets).subspan(first, level.nodes[i + 1].facets - first));
        }
    }
};

}  // namespace

bool is_in_view(Visit& visit, const ViewVolume& volume) {
    // The radius of the ball around a cube is slightly more than half its diagonal, for rounding.
    if (visit.containment != Containment::inside)
        visit.containment =
            volume.containment(visit.centre, 0.8661F * visit.edge + volume.rounding_m());
    return visit.containment != Containment::outside;
}

bool Octree::add_node(const CubeIndex& tile, LevelNode node,
                      std::span<const std::uint32_t> triangles, Level& level) const {
    node.facets = static_cast<std::uint32_t>(level.facets.size());
    const int count = maker_.append(cube(index_of(tile, node)), triangles, level.facets);
    if (count == 0) return false;
    node.flat = count == 1 && is_flat_rectangle(level.facets.back());
    level.nodes.push_back(node);
    return true;
}

std::shared_ptr<const Level> Octree::level_of_cube(const CubeIndex& index,
                                                   std::span<const std::uint32_t> triangles) const {
    Level level;
    if (!add_node(index, {}, triangles, level)) return nullptr;
    close(level);
    return std::make_shared<const Level>(std::move(level));
}

void Octree::add_children(const UpperNode& tile, const LevelNode& node, Level& finer) const {
    const Cube parent = cube(index_of(tile.index, node));
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

std::shared_ptr<const Level> Octree::grown(const UpperNode& tile,
                                           std::shared_ptr<const Level> level, int depth) const {
    while (level->depth < depth) {
        auto finer = std::make_shared<Level>();
        finer->depth = level->depth + 1;
        for (const LevelNode& node : std::span(level->nodes).first(level->nodes.size() - 1)) {
            finer->children.push_back(static_cast<std::uint32_t>(finer->nodes.size()));
            if (node.flat && finer->depth - node.level <= flat_levels_) {
                finer->nodes.push_back(node);
                finer->nodes.back().facets = static_cast<std::uint32_t>(finer->facets.size());
                finer->facets.push_back(LeafFacet(level->facets[node.facets]));
            } else {
                add_children(tile, node, *finer);
            }
        }
        finer->children.push_back(static_cast<std::uint32_t>(finer->nodes.size()));
        finer->children.shrink_to_fit();
        close(*finer);
        finer->coarser = std::move(level);
        level = std::move(finer);
    }
    return level;
}

void Octree::visit_leaves(const PreparedView& prepared, const TakeLeaf& take) const {
    for (const TileInView& tile : prepared.tiles) {
        const std::shared_ptr<const Level> leaves =
            tile.level ? tile.level : grown(*tile.node, tile.node->own, tile.depth);
        TileSearch search{prepared.volume, take, tile.root, tile.depth};
        for (const Level* level = leaves.get(); level; level = level->coarser.get())
            search.levels[level->depth] = level;
        search.enter(0, 0, 1, tile.root.containment);
    }
}

}  // namespace sonarsim
