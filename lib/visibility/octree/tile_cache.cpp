#include "visibility/octree/tile_cache.h"

#include <algorithm>
#include <utility>

namespace sonarsim {

void TileCache::count(Tile& tile) {
    std::size_t bytes = 0;
    for (const Level& level : tile.levels)
        bytes += level.bytes();
    if (tile.bytes == 0) {
        const std::lock_guard listed(listing_);
        grown_.push_back(&tile);
    }
    bytes_ += bytes - tile.bytes;
    tile.bytes = bytes;
}

void TileCache::evict(std::size_t fixed_bytes) {
    const std::size_t least = limit_bytes_ / 4;
    const std::size_t limit =
        fixed_bytes + least < limit_bytes_ ? limit_bytes_ - fixed_bytes : least;
    if (bytes_ <= limit) return;
    const std::unique_lock only(evicting_, std::try_to_lock);
    if (!only) return;
    std::vector<std::pair<std::uint64_t, Tile*>> oldest_first;
    {
        const std::lock_guard listed(listing_);
        for (Tile* const tile : std::exchange(grown_, {}))
            oldest_first.emplace_back(tile->last_ping, tile);
    }
    std::stable_sort(oldest_first.begin(), oldest_first.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    // Evicts a quarter of the limit at a time, so that the sort pays.
    auto next = oldest_first.begin();
    for (; next != oldest_first.end() && bytes_ > limit / 4 * 3; ++next) {
        Tile& tile = *next->second;
        const std::unique_lock alone(tile.lock);
        bytes_ -= tile.bytes;
        tile.bytes = 0;
        tile.levels = {};
        ++evictions_;
    }
    const std::lock_guard listed(listing_);
    for (; next != oldest_first.end(); ++next)
        grown_.push_back(next->second);
}

}  // namespace sonarsim
