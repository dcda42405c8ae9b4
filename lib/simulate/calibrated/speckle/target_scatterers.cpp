#include <map>
#include <utility>

#include "core/elementary.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/trace/target_surface.h"

namespace sonarsim {

namespace {

/// Sums over pieces, times cross-section: 1, range, x, y, z, and 1 if it belongs to the highlight.
using Sums = Eigen::Array<float, 8, 1>;
enum Term : int { section, range, x, y, z, highlight };

/// The number of the cell at an offset from the middle one, 21 bits. `size` 0: there is one cell.
std::uint64_t cell_at(float offset, float size) {
    constexpr float max_number = 1e5F;
    if (!(size > 0.0F)) return 0;
    const float number = std::clamp(std::floor(offset / size + 0.5F), -max_number, max_number);
    return static_cast<std::uint64_t>(static_cast<std::int32_t>(number)) & 0x1FFFFFU;
}

/// Facets face the sonar within a few slopes.
bool is_in_highlight(const Backscatter& material, float range_m, float height_m) {
    const float off2 = range_m * range_m - height_m * height_m;
    constexpr float steepest = 0.5F * highlight_slopes * highlight_slopes;
    return off2 * material.inverse_slope2 < steepest * height_m * height_m && material.facet > 0.0F;
}

/// Joins the pieces of one smooth surface. Their cells are found from the middle of the highlight.
void join_surface(std::span<const Sums> pieces, const PointLimits& cell, const Sample& of,
                  PhiloxKey key, PointScatterers& out) {
    Sums all = Sums::Zero();
    Sums bright = Sums::Zero();
    for (const Sums& piece : pieces) {
        all += piece;
        if (piece[highlight] > 0.0F) bright += piece;
    }
    const Sums& about = bright[section] > 0.0F ? bright : all;
    const Sums middle = about / about[section];
    std::vector<std::pair<std::uint64_t, Sums>> runs;  // in one cell
    for (const Sums& piece : pieces) {
        const Sums off = piece / piece[section] - middle;
        const std::uint64_t number = cell_at(off[range], cell.depth_m) << 42U |
                                     cell_at(off[y] / middle[range], cell.sine) << 21U |
                                     cell_at(off[z] / middle[range], cell.elevation_sine);
        if (runs.empty() || runs.back().first != number)
            runs.emplace_back(number, piece);
        else
            runs.back().second += piece;
    }
    std::map<std::uint64_t, Sums> cells;
    for (const auto& [number, sums] : runs)
        cells.try_emplace(number, Sums::Zero()).first->second += sums;
    for (const auto& [number, sums] : cells) {
        const PhiloxBlock words =
            philox({of.instance, of.number - 1, static_cast<std::uint32_t>(number),
                    static_cast<std::uint32_t>(number >> 32U)},
                   key);
        // 1 if the cell holds exactly the highlight.
        const float steady = sums[highlight] > 0.0F ? sums[highlight] / bright[section] *
                                                          (sums[highlight] / sums[section])
                                                    : 0.0F;
        const float strength = steady - (1.0F - steady) * natural_log(unit_float(words.x0));
        const float range_m = sums[range] / sums[section];
        const Eigen::Vector3f direction = sums.segment<3>(x).matrix().normalized();
        out.points.push_back({.position = range_m * direction,
                              .edge_u = Eigen::Vector3f::Zero(),
                              .edge_v = Eigen::Vector3f::Zero(),
                              .normal = -direction,
                              .height_m = range_m,
                              .area_m2 = strength * sums[section],
                              .material = of.material,
                              .instance = of.instance});
        out.turns.push_back(unit_float(words.x1));
    }
}

}  // namespace

PointScatterers join_targets(std::span<const Sample> pieces, ViewShape shape,
                             const PointLimits& cell, const Scattering& scattering, PhiloxKey key) {
    PointScatterers out;
    PatchBlock block;
    std::vector<Sums> surface_sums;
    for (std::size_t first = 0; first < pieces.size();) {
        const auto is_other = [&](const Sample& piece) {
            return piece.instance != pieces[first].instance || piece.number != pieces[first].number;
        };
        const std::span<const Sample> rest = pieces.subspan(first);
        const auto count = std::ranges::find_if(rest, is_other) - rest.begin();
        surface_sums.clear();
        subdivide(rest.first(count), shape, cell, block, [&](const PatchBlock& parts) {
            for (int k = 0; k < parts.count; ++k) {
                const ArrivalLane at = arrival_at(parts.x[k], parts.y[k], parts.z[k]);
                const Backscatter& material = scattering.materials[parts.material[k]];
                const float height_m = parts.height_m[k];
                const float area =
                    parts.area_m2[k] * material.at(std::min(height_m / at.range_m, 1.0F));
                if (!(area > 0.0F)) continue;
                const float is_bright =
                    is_in_highlight(material, at.range_m, height_m) ? 1.0F : 0.0F;
                surface_sums.emplace_back(area * Sums(1.0F, at.range_m, parts.x[k], parts.y[k],
                                                      parts.z[k], is_bright, 0.0F, 0.0F));
            }
        });
        if (!surface_sums.empty()) join_surface(surface_sums, cell, pieces[first], key, out);
        first += count;
    }
    return out;
}

}  // namespace sonarsim
