#include "simulate/labels/ping_shadows.h"

#include <limits>
#include <utility>

namespace sonarsim {

PingShadows::PingShadows(Wanted wanted, const TracedPing& traced, const SurfaceEchoes& echoes,
                         const View& view, const SceneObjects& objects,
                         const VisibilityEngine& engine, const ObjectDirections& directions,
                         std::vector<std::uint8_t> covered)
    : range_bins_(view.range_bins), covered_(std::move(covered)) {
    using By = HiddenSurface::By;
    const RangeBins bins = range_bins(view);
    hidden_ = find_hidden_surface(traced, echoes, view, objects, engine, directions,
                                  wanted.of_all ? By::all : By::objects);
    of_all_.emplace(hidden_.pieces, view);
    if (wanted.of_objects) {
        by_objects_ = hidden_by_objects(hidden_.pieces, objects);
        covered_by_objects_ = hidden_bins(by_objects_, bins, view.beams);
        if (by_objects_.size() < hidden_.pieces.size()) of_objects_.emplace(by_objects_, view);
    }
    if (wanted.of_all) {
        if (covered_.empty()) covered_ = hidden_bins(hidden_.pieces, bins, view.beams);
        return;
    }
    for (std::uint32_t k = 0; k < hidden_.visible_shares.size(); ++k) {
        if (objects.is_background(k))
            hidden_.visible_shares[k] = std::numeric_limits<float>::quiet_NaN();
    }
}

}  // namespace sonarsim
