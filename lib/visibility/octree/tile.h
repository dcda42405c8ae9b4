#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <shared_mutex>
#include <vector>

#include "visibility/octree/leaf.h"

namespace sonarsim {

/// The position of a node: cube (x, y, z) of the 8^level cubes of its level.
struct CubeIndex {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    int level = 0;

    CubeIndex child(int octant) const {
        return {2 * x + (octant & 1), 2 * y + (octant >> 1 & 1), 2 * z + (octant >> 2), level + 1};
    }
};

/// A node of a level. Its cube may be larger than the level's: a node whose surface is one flat
/// rectangle is not split until the level is a few times finer, since its parts would add nothing.
struct LevelNode {
    std::uint16_t x, y, z;       ///< index of its cube among those of its size within the tile
    std::uint8_t level;          ///< level of its cube below the tile's
    bool flat;                   ///< one flat rectangle
    std::uint32_t facets;        ///< index of its first facet
    std::uint32_t children = 0;  ///< index of its first child in the next level, if there is one
};

/// All surface of a tile in cubes of one size. Nodes are in the order of their parents, so the
/// descendants of a node are one run of nodes and of facets in every finer level. The last node is
/// a sentinel.
struct Level {
    std::vector<LevelNode> nodes;
    FacetArrays facets;

    std::size_t bytes() const {
        return sizeof(Level) + nodes.capacity() * sizeof(LevelNode) + facets.bytes();
    }
};

/// A subtree over few triangles, the unit of growth and eviction. Readers hold `lock` shared; a
/// thread that grows or drops it holds it exclusively.
struct Tile {
    CubeIndex index;
    std::vector<std::uint32_t> triangles;
    std::shared_mutex lock;
    std::vector<Level> levels;                ///< [0] is the tile's own cube; none when dropped
    std::size_t bytes = 0;                    ///< size of the levels, as counted by the cache
    std::atomic<std::uint64_t> last_ping{0};  ///< last ping that searched the tile
};

}  // namespace sonarsim
