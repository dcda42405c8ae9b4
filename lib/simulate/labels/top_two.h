#pragma once

#include "simulate/trace/range_boxes.h"

namespace sonarsim {

/// A source of EchoSums and its key, such as the object that it is a part of.
struct KeyedSource {
    std::uint32_t key, source;
};

/// The keys with the two largest echoes in the bins of a beam; all is 0 before.
struct TopTwo {
    std::span<std::uint16_t> first, second;  ///< 1 + key; 0: none. `second`: empty unless requested
    std::span<float> first_echo = {}, second_echo = {};  ///< second_echo: only with `second`
};

/// Finds the keys with the largest echoes in every bin, summed by key; among equals the lowest.
class TopTwoFinder {
  public:
    /// Sources of one key are added in the order in which they are given.
    explicit TopTwoFinder(std::vector<KeyedSource> sources);

    void find(const EchoSums& sums, int beam, const TopTwo& out);

  private:
    std::vector<KeyedSource> sources_;  ///< sorted by key
    std::vector<float> echo_;           ///< the echo of one key
    std::vector<float> first_echo_;
};

}  // namespace sonarsim
