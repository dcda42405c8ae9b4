#pragma once

#include <cstddef>
#include <cstdint>

namespace sonarsim {

struct OctreeOptions {
    double leaf_m = 0.0;          ///< edge of the leaves; 0: follows the view's bins
    std::size_t memory_mb = 512;  ///< limit; beyond it the least recently used tiles are dropped
    bool literal = false;         ///< the paper's method unchanged: leaf centres, one vote a leaf
};

struct OctreeStatistics {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;  ///< nodes without children
    std::uint64_t bytes = 0;
    std::uint64_t ping_bytes = 0;  ///< memory of the tiles of the most demanding ping
    std::uint64_t evictions = 0;   ///< tiles dropped so far
    double leaf_area_m2 = 0.0;     ///< surface held by all leaves
};

}  // namespace sonarsim
