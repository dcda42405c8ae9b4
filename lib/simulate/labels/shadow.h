#pragma once

#include "simulate/labels/hidden_surface.h"
#include "simulate/labels/top_two.h"

namespace sonarsim {

/// Finds the bins in shadow: they hold surface, and none of it is visible. A bin in shadow gets the
/// object that hides most of its surface by solid angle. If no sight line ends in it, it gets the
/// object of the nearest bin of its beam in which one does.
class ShadowFinder {
  public:
    /// `pieces`: the hidden surface.
    ShadowFinder(std::span<const HiddenPiece> pieces, const View& view);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `covered` is 1 for the bins that some surface falls into, `occupied` for those that show it.
    void find(int j, std::span<const std::uint8_t> covered, std::span<const std::uint8_t> occupied,
              std::span<std::uint16_t> shadow);

  private:
    std::vector<std::uint16_t>& owners(int j);

    std::size_t range_bins_;
    EchoSums sums_;  ///< the solid angles of hidden surface, by the object that hides it
    TopTwoFinder finder_;
    /// [beams][range bins]: 1 + the object that hides most there, 0: none; empty: not computed.
    std::vector<std::vector<std::uint16_t>> owners_;
};

/// 1 for the bins of a beam that show surface, where echoes are energies and a beam is wider than
/// the shadow of a small thing, so that its borders receive some surface beside the shadow. A bin
/// with hidden surface (`hidden` is 1) shows none if its echo is 10 dB below the level of the
/// sources `ground`, between the medians of the nearest bins without hidden surface on either side.
std::vector<std::uint8_t> bins_above_shadow(const EchoSums& sums, int beam,
                                            std::span<const std::uint32_t> ground,
                                            std::span<const std::uint8_t> hidden);

}  // namespace sonarsim
