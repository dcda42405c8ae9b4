#pragma once

#include <algorithm>
#include <cstddef>

namespace sonarsim {

/// Divides items into turns of `each` items. A thread takes one turn after another. Each of the
/// last items is a turn of its own, so that threads end at about the same time.
class Turns {
  public:
    Turns(std::size_t items, std::size_t each, std::size_t threads) : items_(items), each_(each) {
        constexpr std::size_t single_for_a_thread = 4;
        if (each > 1) long_ = (items - std::min(items, single_for_a_thread * threads)) / each;
    }

    std::size_t count() const { return items_ - long_ * (each_ - 1); }
    /// The first item of a turn, or the number of items for count().
    std::size_t begin(std::size_t turn) const { return turn + std::min(turn, long_) * (each_ - 1); }

  private:
    std::size_t items_;
    std::size_t each_;
    std::size_t long_ = 0;  ///< number of turns of `each_` items
};

}  // namespace sonarsim
