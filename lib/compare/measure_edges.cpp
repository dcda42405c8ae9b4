#include "compare/measure_edges.h"

#include <algorithm>
#include <cmath>

#include "compare/figures/edges.h"
#include "core/in_parallel.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The number of images in which edges are sought. More images of the same places would add little.
constexpr std::size_t most_images = 32;

/// The step from a beam to the next, in degrees.
double beam_step_deg(const std::vector<double>& bearing_rad, int beam) {
    const auto last = static_cast<int>(bearing_rad.size()) - 1;
    const int from = std::max(beam - 1, 0);
    const int to = std::min(beam + 1, last);
    return degrees(std::fabs(bearing_rad[static_cast<std::size_t>(to)] -
                             bearing_rad[static_cast<std::size_t>(from)])) /
           (to - from);
}

}  // namespace

void measure_edges(const RecordedImages& images, PatchSize size, const Zones& zones,
                   Measurement& out) {
    if (images.columns_are_pings || images.powers.empty()) return;
    const RangeZone nearest = zones.water.to > zones.water.from ? zones.water : zones.bottom;
    const EdgeSearch search{size, {nearest.from, images.ranges}, images.full_power};
    const PatchGrid grid = images.grid(size);
    const std::size_t every = (images.powers.size() + most_images - 1) / most_images;
    std::vector<std::vector<Edge>> found(2 * ((images.powers.size() + every - 1) / every));
    in_parallel(found.size(), [&](std::size_t k) {
        const StepAlong along = k % 2 == 0 ? StepAlong::range : StepAlong::bearing;
        found[k] = edges_of(images.image(k / 2 * every), search, along);
    });
    Measured range{"edges: width, m", Reduce::quantile, Tolerance::tenth, 0.5, {}};
    Measured bearing{"edges: width, degrees", Reduce::quantile, Tolerance::tenth, 0.5, {}};
    for (std::size_t k = 0; k < found.size(); ++k) {
        for (const Edge& edge : found[k]) {
            const double unit =
                k % 2 == 0 ? images.range_step_m : beam_step_deg(images.bearing_rad, edge.beam);
            Measured& figure = k % 2 == 0 ? range : bearing;
            figure.cells.push_back({grid.place_of(edge.range, edge.beam),
                                    static_cast<int>(k / 2 * every),
                                    static_cast<float>(unit * edge.width), 1.0F});
        }
    }
    for (Measured* figure : {&range, &bearing}) {
        if (!figure->cells.empty()) out.figures.push_back(std::move(*figure));
    }
}

}  // namespace sonarsim
