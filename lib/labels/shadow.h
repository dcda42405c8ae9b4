#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "labels/shares.h"
#include "ping/form_image.h"
#include "scene/objects.h"

namespace sonarsim {

/// Finds the bins that would show surface if nothing stood before it. Sight lines go on behind what
/// they met first; what they meet there is hidden. A bin that shows no surface and holds some that
/// is hidden lies in the shadow of what hides most of it, counted by solid angle. Open water holds
/// neither. The far side of a body is hidden by the body itself.
class ShadowFinder {
  public:
    /// Traces the hidden surface, where `on`. The arguments must outlive the finder.
    ShadowFinder(const TracedPing& traced, const View& view, const SceneObjects& objects,
                 const VisibilityEngine& engine, bool on);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `lit` is not 0 for the bins that show surface.
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

    RangeBins bins_;
    std::vector<SolidAngles> solid_angles_;  ///< by object
    std::vector<Hidden> hidden_;             ///< of the sight lines, layer by layer
    std::vector<std::uint32_t> beam_begin_;  ///< beams + 1 offsets into `places_`
    std::vector<Place> places_;              ///< of hidden surface, sorted by beam
    BeamShares shares_;
    StrongestFinder finder_;
    Strongest strongest_;
    Echoes echoes_;
};

}  // namespace sonarsim
