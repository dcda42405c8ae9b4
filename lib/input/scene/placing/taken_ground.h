#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "input/scene/placing/hull.h"

namespace sonarsim {

/// The ground that objects cover, seen from above. A hull is compared only with those near it, so
/// that the time to scatter objects grows with their number and not with its square.
class TakenGround {
  public:
    void add(Hull hull);

    /// True if a hull meets none of those that were added, and comes nearer than `spacing_m` to
    /// none.
    bool has_room(const Hull& room, double spacing_m) const;

  private:
    /// Hulls of about one size, by the column and row of the square cell that holds the middle of
    /// their box. Only cells with a hull are kept, in order.
    using Cells = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Hull>>;

    /// The cells of each size, whose binary exponent is the key, m. Cells are wider than their
    /// hulls.
    std::map<int, Cells> levels_;
};

}  // namespace sonarsim
