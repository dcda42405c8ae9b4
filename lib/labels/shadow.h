#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "labels/hidden_surface.h"
#include "labels/shares.h"

namespace sonarsim {

/// Finds the bins in shadow: they hold surface, and none of it is visible. A bin in shadow gets the
/// object that hides most of its surface by solid angle. If no sight line ends in it, it gets the
/// object of the nearest bin in which one does.
class ShadowFinder {
  public:
    /// `pieces`: the hidden surface. They must outlive the finder.
    ShadowFinder(std::span<const HiddenPiece> pieces, const View& view);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `covered` is 1 for the bins that some surface falls into, `occupied` for those that show
    /// surface.
    void find(int j, std::span<const std::uint8_t> covered, std::span<const std::uint8_t> occupied,
              std::span<std::uint16_t> shadow);

  private:
    /// The index of a piece of hidden surface in `pieces_`.
    struct Place {
        std::uint32_t object, at;

        auto operator<=>(const Place&) const =
            default;  // NOLINT(modernize-use-nullptr): no pointer
    };

    void find_owners(int j, std::span<std::uint16_t> owners);
    std::span<const std::uint16_t> nearest_owners(int j);
    std::vector<std::uint16_t>& owners(int j);

    RangeBins bins_;
    bool full_turn_;
    std::span<const HiddenPiece> pieces_;
    std::vector<std::uint32_t> beam_begin_;  ///< beams + 1 offsets into `places_`
    std::vector<Place> places_;              ///< sorted by beam
    /// [beams][range bins]: 1 + the object that hides most there; 0: no line ends there. Empty: not
    /// computed yet.
    std::vector<std::vector<std::uint16_t>> owners_;
    BeamShares shares_;
    TopTwoFinder finder_;
    TopTwo strongest_;
    RangeBoxes echoes_;
};

}  // namespace sonarsim
