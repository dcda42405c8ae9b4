#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <vector>

#include "visibility/octree/clip.h"
#include "visibility/octree/leaf.h"
#include "visibility/octree/octree_engine.h"

namespace sonarsim {

/// Where a node lies: cube (x, y, z) of the 8^level cubes of its level.
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
/// rectangle is not split before the level is a few times finer, its parts would say the same.
struct LevelNode {
    std::uint16_t x, y, z;       ///< which of the cubes of its size within the tile
    std::uint8_t level;          ///< of its cube, below the tile's
    bool flat;                   ///< one flat rectangle
    std::uint32_t facets;        ///< index of its first
    std::uint32_t children = 0;  ///< index of its first in the next level, where there is one
};

/// All surface of a tile in cubes of one size. Nodes lie in the order of their parents, so what is
/// below a node is one run of nodes and of facets in every finer level. The last node is a
/// sentinel.
struct Level {
    std::vector<LevelNode> nodes;
    FacetArrays facets;
};

/// A subtree over few triangles, the unit of growth and eviction. Readers hold `lock` shared; who
/// grows or drops it, alone.
struct Tile {
    CubeIndex index;
    std::vector<std::uint32_t> triangles;
    std::shared_mutex lock;
    std::vector<Level> levels;                ///< [0] is the tile's own cube; none when dropped
    std::size_t bytes = 0;                    ///< as last counted
    std::atomic<std::uint64_t> last_ping{0};  ///< that searched the tile
};

/// A node above the tiles.
struct TopNode {
    CubeIndex index;
    Level level;                           ///< the node alone
    std::vector<std::uint32_t> triangles;  ///< until it is split
    std::uint32_t children = 0;
    std::uint8_t octants = 0;
    std::unique_ptr<Tile> tile;  ///< instead of children
};

/// The octree: a top of nodes with long lists of triangles, tiles below it. What a node holds
/// depends on its cube and the scene alone, so it matters to nobody who grew it, or when.
class Octree {
  public:
    Octree(const Scene& scene, const Caster& caster, const OctreeOptions& options);

    Cube cube(const CubeIndex& index) const;
    double edge_m(int level) const;

    /// The top; index 0 is the root. Under `top_lock`, except that the level and the tile of a
    /// node once made stay where they are.
    const TopNode& top(std::uint32_t node) const { return top_[node]; }
    std::shared_mutex& top_lock() const { return top_lock_; }

    /// Splits a node of the top. Needs `top_lock` alone.
    void split(std::uint32_t top_node);

    /// Grows a tile until it has `levels` levels. Needs its lock alone.
    void grow(Tile& tile, int levels);

    /// Drops what has not been seen for longest when memory is short. No lock may be held.
    void evict();

    std::uint64_t next_ping() { return ++pings_; }

    OctreeStatistics statistics() const;

  private:
    void add_top(const CubeIndex& index, std::vector<std::uint32_t> triangles);
    bool add_node(const CubeIndex& tile, const LevelNode& node,
                  std::span<const std::uint32_t> triangles, Level& level) const;
    void split(const Tile& tile, const LevelNode& node, Level& finer) const;

    LeafMaker maker_;
    Eigen::Vector3d min_;
    double edge_m_ = 0.0;
    double tile_edge_m_ = 0.0;
    std::size_t budget_;
    int flat_levels_;  ///< how much larger than a leaf a flat node may be, as a power of 2
    mutable std::shared_mutex top_lock_;
    std::deque<TopNode> top_;
    std::atomic<std::size_t> bytes_{0};
    std::atomic<std::uint64_t> pings_{0};
    std::atomic<std::uint64_t> evictions_{0};
    std::mutex evicting_;
};

}  // namespace sonarsim
