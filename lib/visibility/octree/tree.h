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
    Level level;                           ///< this node only
    std::vector<std::uint32_t> triangles;  ///< empty once it is split
    std::uint32_t children = 0;
    std::uint8_t octants = 0;
    std::unique_ptr<Tile> tile;  ///< instead of children
};

/// The octree: top nodes with long lists of triangles, and tiles below them. A node's contents
/// depend only on its cube and the scene, not on the thread or the ping that grew it.
class Octree {
  public:
    Octree(const Scene& scene, const Caster& caster, const OctreeOptions& options);

    Cube cube(const CubeIndex& index) const;
    double edge_m(int level) const;

    /// The top; index 0 is the root. Needs `top_lock`, except that the level and the tile of a node
    /// stay at their address.
    const TopNode& top(std::uint32_t node) const { return top_[node]; }
    std::shared_mutex& top_lock() const { return top_lock_; }

    /// Splits a node of the top. Needs `top_lock` exclusively.
    void split(std::uint32_t top_node);

    /// Grows a tile to `levels` levels. Needs its lock exclusively.
    void grow(Tile& tile, int levels);

    /// Drops the least recently used tiles when memory is short. The caller must hold no lock.
    void evict() { cache_.evict(top_bytes_); }

    std::uint64_t next_ping() { return ++pings_; }

    /// Notes the bytes of the tiles that a ping has searched.
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
    int flat_levels_;  ///< largest ratio of a flat node's size to a leaf, as a power of 2
    mutable std::shared_mutex top_lock_;
    std::deque<TopNode> top_;
    std::atomic<std::size_t> top_bytes_{0};
    std::atomic<std::size_t> most_ping_bytes_{0};
    std::atomic<std::uint64_t> pings_{0};
    TileCache cache_;
};

/// The greatest length of a scene that these options can divide into leaves: 2^30 of them, less one
/// at either end.
double longest_octree_scene_m(const OctreeOptions& options);

}  // namespace sonarsim
