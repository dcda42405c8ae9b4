#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sonarsim {

/// Disjoint sets of the numbers from 0 to before `count` (union-find).
class JoinedSets {
  public:
    explicit JoinedSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    /// The number that stands for the set of `k`.
    std::uint32_t of(std::uint32_t k) {
        while (parent_[k] != k)
            k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    /// Joins the sets of `a` and `b`.
    void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace sonarsim
