#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

#include "visibility/octree/clip.h"
#include "visibility/octree/leaf.h"
#include "visibility/octree/options.h"
#include "visibility/octree/tile.h"
#include "visibility/octree/tile_cache.h"

namespace sonarsim {

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

    /// Drops what no ping has searched for longest when memory is short. No lock may be held.
    void evict() { cache_.evict(top_bytes_); }

    std::uint64_t next_ping() { return ++pings_; }

    /// Notes how many bytes of tiles a ping has searched.
    void note_ping_bytes(std::size_t bytes);

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
    int flat_levels_;  ///< how much larger than a leaf a flat node may be, as a power of 2
    mutable std::shared_mutex top_lock_;
    std::deque<TopNode> top_;
    std::atomic<std::size_t> top_bytes_{0};
    std::atomic<std::size_t> most_ping_bytes_{0};
    std::atomic<std::uint64_t> pings_{0};
    TileCache cache_;
};

/// The longest scene, along its longest side, that these options can divide into leaves: 2^30 of
/// them, less one at either end.
double longest_octree_scene_m(const OctreeOptions& options);

}  // namespace sonarsim
