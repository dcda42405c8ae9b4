#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "visibility/octree/tile.h"

namespace sonarsim {

/// Bounds the memory of grown tiles: drops those that no ping has searched for longest.
class TileCache {
  public:
    explicit TileCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

    /// Counts the bytes of a tile that has grown. Needs the tile's lock alone.
    void count(Tile& tile);

    /// Drops tiles where they and the `fixed_bytes` of the rest of the tree exceed the limit. A
    /// quarter of the limit is left to the tiles in any case. No lock may be held.
    void evict(std::size_t fixed_bytes);

    std::size_t bytes() const { return bytes_; }
    std::uint64_t evictions() const { return evictions_; }

  private:
    std::size_t limit_bytes_;
    std::atomic<std::size_t> bytes_{0};
    std::atomic<std::uint64_t> evictions_{0};
    std::mutex evicting_;
    std::mutex listing_;        ///< guards `grown_`; may be taken while a tile's lock is held
    std::vector<Tile*> grown_;  ///< all tiles that have levels
};

}  // namespace sonarsim
