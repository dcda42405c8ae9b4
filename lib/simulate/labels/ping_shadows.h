#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "simulate/labels/shadow.h"

namespace sonarsim {

/// The shadows of a ping: those of all objects, and those of objects that are no background. Both
/// are found from one trace of the hidden surface.
class PingShadows {
  public:
    /// The shadows to find.
    struct Wanted {
        bool of_all = false;
        bool of_objects = false;
    };

    /// `covered` are the bins with surface, see covered_bins(); if empty, those where sight lines
    /// meet hidden surface. The other arguments are those of find_hidden_surface().
    PingShadows(Wanted wanted, const TracedPing& traced, const SurfaceEchoes& echoes,
                const View& view, const SceneObjects& objects, const VisibilityEngine& engine,
                const ObjectDirections& directions, std::vector<std::uint8_t> covered);
    /// Not copied: the finders refer to the members.
    PingShadows(const PingShadows&) = delete;
    PingShadows& operator=(const PingShadows&) = delete;

    /// The shadows of beam j, as ShadowFinder::find() gives them.
    void find_of_all(int j, std::span<const std::uint8_t> occupied,
                     std::span<std::uint16_t> shadow) {
        of_all_->find(j, row(covered_, j), occupied, shadow);
    }
    void find_of_objects(int j, std::span<const std::uint8_t> occupied,
                         std::span<std::uint16_t> shadow) {
        ShadowFinder& finder = of_objects_ ? *of_objects_ : *of_all_;
        finder.find(j, row(covered_by_objects_, j), occupied, shadow);
    }

    /// See HiddenSurface; without shadows of all objects it is NaN for background.
    const std::vector<float>& visible_shares() const { return hidden_.visible_shares; }

  private:
    std::span<const std::uint8_t> row(const std::vector<std::uint8_t>& all, int j) const {
        return std::span(all).subspan(static_cast<std::size_t>(j) * range_bins_, range_bins_);
    }

    int range_bins_;
    HiddenSurface hidden_;
    std::vector<HiddenPiece> by_objects_;
    std::optional<ShadowFinder> of_all_;
    std::optional<ShadowFinder> of_objects_;  ///< empty: no background hides anything
    std::vector<std::uint8_t> covered_, covered_by_objects_;  ///< [beams, range bins]
};

}  // namespace sonarsim
