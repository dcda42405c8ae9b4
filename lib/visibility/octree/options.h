#pragma once

#include <cstddef>
#include <cstdint>

namespace sonarsim {

struct OctreeOptions {
    double leaf_m = 0.0;          ///< edge of the leaves; 0: what the view's bins call for
    std::size_t memory_mb = 512;  ///< above this, what no ping has seen for longest is dropped
    bool literal = false;         ///< the paper to the letter: leaf centres, one leaf one vote
};

struct OctreeStatistics {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;  ///< nodes without children
    std::uint64_t facets = 0;  ///< pieces of surface held by all nodes
    std::uint64_t bytes = 0;
    std::uint64_t ping_bytes = 0;  ///< that the most demanding ping so far needed
    std::uint64_t evictions = 0;   ///< subtrees dropped so far
    double leaf_area_m2 = 0.0;     ///< the surface held by all leaves
};

}  // namespace sonarsim
