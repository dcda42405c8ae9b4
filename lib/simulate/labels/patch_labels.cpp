#include "simulate/labels/patch_labels.h"

#include <algorithm>
#include <optional>

#include "simulate/labels/elevation.h"
#include "simulate/labels/height.h"

namespace sonarsim {

namespace {

/// The finders that a request needs.
struct PatchFinders {
    std::optional<ElevationFinder> elevation;
    std::optional<HeightFinder> height;

    /// Adds the echoes of a patch. `row_of(echo)`: the row of sums of its beam.
    template <class RowOf>
    void add(const SurfaceEchoes& echoes, const EchoPatch& patch, const RangeBins& bins,
             RowOf row_of) {
        const auto own = std::span(echoes.patch_echoes)
                             .subspan(patch.echo_begin, patch.echo_end - patch.echo_begin);
        const RangePath path = range_path(patch);
        if (elevation) elevation->begin(patch, path);
        const bool has_height = height && height->begin(patch, path);
        if (!elevation && !has_height) return;
        for_each_covered(path, bins, [&](const CoveredBins& covered) {
            if (elevation) elevation->cover(covered);
            if (has_height) height->cover(covered);
            for (const PatchEcho& echo : own) {
                if (!(echo.echo > 0.0)) continue;
                if (elevation) elevation->add(row_of(echo), echo.echo, covered);
                if (has_height) height->add(row_of(echo), echo.echo, covered);
            }
        });
    }
};

}  // namespace

void label_patches(const SurfaceEchoes& echoes, const View& view, const TruePlaces& places,
                   const Bottom* bottom, std::span<const std::uint8_t> is_bottom,
                   const PatchLabels& labels) {
    const RangeBins bins = range_bins(view);
    // Patches that are sorted by beam need one row of sums, which stays in the cache.
    const bool sorted = !echoes.patch_begin.empty();
    const int rows = sorted ? 1 : view.beams;
    PatchFinders finders;
    if (!labels.elevation_rad.empty()) finders.elevation.emplace(bins, rows);
    if (!labels.height_m.empty() && bottom != nullptr)
        finders.height.emplace(bins, rows, *bottom, is_bottom, places);
    if (!sorted) {
        for (const EchoPatch& patch : echoes.patches)
            finders.add(echoes, patch, bins, [](const PatchEcho& echo) { return echo.beam; });
    }
    for (int j = 0; j < view.beams; ++j) {
        if (sorted) {
            for (std::uint32_t k = echoes.patch_begin[j]; k < echoes.patch_begin[j + 1]; ++k)
                finders.add(echoes, echoes.patches[k], bins, [](const PatchEcho&) { return 0U; });
        }
        const auto own = [&](std::span<float> all) {
            return all.subspan(static_cast<std::size_t>(j) * view.range_bins, view.range_bins);
        };
        const auto row = static_cast<std::uint32_t>(sorted ? 0 : j);
        if (finders.elevation) {
            finders.elevation->find(row, own(labels.elevation_rad),
                                    own(labels.elevation_spread_rad));
        }
        if (finders.height) finders.height->find(row, own(labels.height_m));
    }
}

}  // namespace sonarsim
