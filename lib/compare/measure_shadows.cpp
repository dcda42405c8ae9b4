#include "compare/measure_shadows.h"

#include <algorithm>
#include <cmath>

#include "compare/figures/shadows.h"

namespace sonarsim {

void measure_shadows(const RecordedImages& images, PatchSize size, const Zones& zones,
                     Measurement& out) {
    const RangeZone zone{zones.bottom.from, images.ranges};
    const PatchGrid grid = images.grid(size);
    const int columns = std::max(1, grid.columns);
    Measured share{"shadows: share of the bottom", Reduce::mean, Tolerance::share, 0.5, {}};
    Measured depth{"shadows: depth, dB", Reduce::quantile, Tolerance::decibel, 0.5, {}};
    Measured edge{"shadows: far edge, ranges", Reduce::quantile, Tolerance::tenth, 0.5, {}};
    for (std::size_t k = 0; k < images.powers.size(); ++k) {
        const int ping = static_cast<int>(k);
        std::vector<float> dark(static_cast<std::size_t>(columns) *
                                static_cast<std::size_t>(images.ranges / size.ranges + 1));
        for (const Shadow& shadow : shadows_of(images.image(k), zone)) {
            const int place = grid.place_of(shadow.from, shadow.column);
            depth.cells.push_back({place, ping, static_cast<float>(shadow.depth_db), 1.0F});
            if (std::isfinite(shadow.edge_ranges))
                edge.cells.push_back({place, ping, static_cast<float>(shadow.edge_ranges), 1.0F});
            for (int i = shadow.from; i < shadow.to; ++i)
                dark[static_cast<std::size_t>(grid.place_of(i, shadow.column))] += 1.0F;
        }
        const float part = 1.0F / static_cast<float>(size.values());
        for (int range = zone.from; range + size.ranges <= zone.to; range += size.ranges) {
            for (int column = 0; column < columns; ++column) {
                const int place = grid.place_of(range, column * size.beams);
                share.cells.push_back(
                    {place, ping, part * dark[static_cast<std::size_t>(place)], 1.0F});
            }
        }
    }
    for (Measured* figure : {&share, &depth, &edge}) {
        if (!figure->cells.empty()) out.figures.push_back(std::move(*figure));
    }
}

}  // namespace sonarsim
