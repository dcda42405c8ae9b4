#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "labels/shares.h"
#include "ping/form_image.h"
#include "scene/objects.h"

namespace sonarsim {

/// Finds the bins that lie in shadow: some surface falls into them, and they show none. Sight lines
/// go on behind what they met first; what they meet there is hidden. A bin in shadow belongs to
/// what hides most of its surface, counted by solid angle, or of the nearest bin where sight lines
/// end. The far side of a body is hidden by the body itself.
class ShadowFinder {
  public:
    /// Traces the hidden surface, where `on`. The arguments must outlive the finder.
    ShadowFinder(const TracedPing& traced, const View& view, const SceneObjects& objects,
                 const VisibilityEngine& engine, bool on);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `lit` is 1 for the bins that show surface, else 0.
    void find(int j, std::span<const std::uint8_t> lit, std::span<std::uint16_t> shadow);

    /// Of each object, the part of its solid angle within the range that nothing hides; NaN for an
    /// object that no sight line meets. An object does not hide itself.
    std::vector<float> visible_shares() const;

  private:
    /// What sight lines meet of an object, sr.
    struct SolidAngles {
        double visible = 0.0, hidden = 0.0;
    };

    /// Hidden surface, seen through what is before it.
    struct Hidden {
        std::uint32_t beam, object;  ///< the object that hides it
        float range_m, half_m, solid_angle;
    };

    /// Where the hidden surface of an object stands in `hidden_`.
    struct Place {
        std::uint32_t object, at;

        auto operator<=>(const Place&) const =
            default;  // NOLINT(modernize-use-nullptr): no pointer
    };

    void sort_into_beams(int beams);
    void find_owners(int j, std::span<std::uint16_t> owners);
    std::span<const std::uint16_t> nearest_owners(int j);

    std::vector<std::uint16_t>& owners(int j);

    RangeBins bins_;
    std::vector<SolidAngles> solid_angles_;  ///< by object
    std::vector<Hidden> hidden_;             ///< of the sight lines, layer by layer
    std::vector<std::uint32_t> beam_begin_;  ///< beams + 1 offsets into `places_`
    std::vector<Place> places_;              ///< of hidden surface, sorted by beam
    std::vector<std::uint8_t> covered_;      ///< [beams, range bins]: some surface falls into it
    /// [beams][range bins]: 1 + what hides most there; 0: no line ends there. Empty: not yet asked.
    std::vector<std::vector<std::uint16_t>> owners_;
    BeamShares shares_;
    StrongestFinder finder_;
    Strongest strongest_;
    Echoes echoes_;
};

}  // namespace sonarsim
