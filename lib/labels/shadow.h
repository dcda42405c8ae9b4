#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "labels/object_directions.h"
#include "labels/shares.h"
#include "ping/form_image.h"
#include "scene/objects.h"
#include "trace/cone_beams.h"

namespace sonarsim {

struct SightLine;

/// Finds the bins in shadow: surface falls into them, and none of it is visible. Sight lines
/// continue behind the first surface that they meet; the surface that they meet there is hidden. A
/// bin in shadow gets the object that hides most of its surface, by solid angle, or that of the
/// nearest bin in which sight lines end. A body hides its own far side.
class ShadowFinder {
  public:
    /// The surfaces that all sight lines meet behind the visible one: by layer, then by the number
    /// of the line.
    using Behind = std::vector<std::vector<Intersection>>;

    /// The shadows to find: those of all objects, or those of objects that are no background.
    enum class Of { all, annotated };

    /// Traces the hidden surface, but not where `directions` say that there is none. With
    /// `annotated` only that which objects that are no background hide, or that of these objects,
    /// which lie in `directions`; this costs little where they are small. A finder for `all` writes
    /// to `behind`; one for `annotated` then traces nothing, but reads from it unless it is empty.
    /// The arguments must outlive the finder.
    ShadowFinder(const TracedPing& traced, const ConeBeams& cones, const View& view,
                 const SceneObjects& objects, const VisibilityEngine& engine,
                 const ObjectDirections& directions, Of of, Behind& behind);

    /// Fills `shadow` [range bins] of beam j with 1 + the index of the object that hides, or 0.
    /// `occupied` is 1 for the bins that show surface, else 0.
    void find(int j, std::span<const std::uint8_t> occupied, std::span<std::uint16_t> shadow);

    /// The share of each object's solid angle within the range that nothing hides; NaN for an
    /// object that no sight line meets. An object does not hide itself.
    std::vector<float> visible_shares() const;

  private:
    /// The solid angle of an object that sight lines meet, sr.
    struct SolidAngles {
        double visible = 0.0, hidden = 0.0;
    };

    /// Hidden surface behind another one.
    struct Hidden {
        std::uint32_t beam, object;  ///< the object that hides it
        float range_m, half_m, solid_angle;
    };

    /// The index of an object's hidden surface in `hidden_`.
    struct Place {
        std::uint32_t object, at;

        auto operator<=>(const Place&) const =
            default;  // NOLINT(modernize-use-nullptr): no pointer
    };

    /// Adds the pieces of hidden surface that lie in different beams of a line array. `whole` is
    /// all the surface that the line meets, a piece of the plane with this normal.
    void add_to_cones(const SightLine& line, const Hidden& whole, const Eigen::Vector3f& normal,
                      const ConeBeams& cones);
    /// 1 for the bins [beams, range bins] that hold hidden surface.
    std::vector<std::uint8_t> hidden_bins(int beams) const;
    void sort_into_beams(int beams);
    void find_owners(int j, std::span<std::uint16_t> owners);
    std::span<const std::uint16_t> nearest_owners(int j);

    std::vector<std::uint16_t>& owners(int j);

    RangeBins bins_;
    bool follows_objects_;  ///< covered_ and hidden_ hold the shadows of objects alone
    std::vector<SolidAngles> solid_angles_;  ///< indexed by object
    std::vector<Hidden> hidden_;             ///< all hidden surface, layer by layer
    std::vector<std::uint32_t> beam_begin_;  ///< beams + 1 offsets into `places_`
    std::vector<Place> places_;              ///< sorted by beam
    std::vector<std::uint8_t> covered_;      ///< [beams, range bins]: some surface falls into it
    /// [beams][range bins]: 1 + the object that hides most there; 0: no line ends there. Empty: not
    /// computed yet.
    std::vector<std::vector<std::uint16_t>> owners_;
    BeamShares shares_;
    StrongestFinder finder_;
    Strongest strongest_;
    RangeBoxes echoes_;
};

}  // namespace sonarsim
