#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "visibility/octree/tile.h"

namespace sonarsim {

/// Limits the memory of grown tiles: drops the least recently used ones.
class TileCache {
  public:
    explicit TileCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

    /// Counts the bytes of a tile that has grown. Needs the tile's lock exclusively.
    void count(Tile& tile);

    /// Drops tiles if they and the `fixed_bytes` of the rest of the tree exceed the limit. Tiles
    /// always keep a quarter of the limit. The caller must hold no lock.
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
