#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/labels/hidden_surface.h"
#include "simulate/labels/top_two.h"

namespace sonarsim {

/// Finds the bins in shadow: they hold surface, and none of it is visible. A bin in shadow gets the
/// object that hides most of its surface by solid angle. If no sight line ends in it, it gets the
/// object of the nearest bin in which one does.
class ShadowFinder {
  public:
    /// `pieces`: the hidden surface.
    ShadowFinder(std::span<const HiddenPiece> pieces, const View& view);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `covered` is 1 for the bins that some surface falls into, `occupied` for those that show
    /// surface.
    void find(int j, std::span<const std::uint8_t> covered, std::span<const std::uint8_t> occupied,
              std::span<std::uint16_t> shadow);

  private:
    std::span<const std::uint16_t> nearest_owners(int j);
    std::vector<std::uint16_t>& owners(int j);

    bool full_turn_;
    std::size_t range_bins_;
    EchoSums sums_;  ///< the solid angles of hidden surface, by the object that hides it
    TopTwoFinder finder_;
    /// [beams][range bins]: 1 + the object that hides most there; 0: no line ends there. Empty: not
    /// computed yet.
    std::vector<std::vector<std::uint16_t>> owners_;
};

}  // namespace sonarsim
