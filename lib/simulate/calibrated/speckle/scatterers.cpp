#include "simulate/calibrated/speckle/scatterers.h"

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

using Floats = PatchBlock::Array<float>;
using Words = PatchBlock::Array<std::uint32_t>;

// Greatest length of cells as a share of the resolution, at which contrast is below 1.02.
constexpr double max_of_resolution = 1.25;

// Scatterers in a resolution cell: amplitudes are about Rayleigh distributed.
constexpr double scatterers_in_cell = 4.0;

// The number of levels by which cells are larger at normal than at grazing incidence.
constexpr int steep_levels = 1;

/// The counters of the cells for their random draws.
void name_cells(const Scatterers& block, int count, Words& low, Words& high) {
    for (int k = 0; k < count; ++k) {
        const CellName name = cell_name(block.cell[0][k], block.cell[1][k], block.cell[2][k]);
        low[k] = name.low;
        // Levels differ in the exponent of the edge.
        high[k] = name.high ^ (std::bit_cast<std::uint32_t>(block.edge_m[k]) >> 23) * 0x9E3779B1U;
    }
}

/// The two-way phases, turns. In double: at 40 m and 2 MHz the last bit of a float is 0.07 rad.
void find_phases(const Scatterers& block, int count, const SonarInScene& sonar, double turns_per_m,
                 Floats& turns) {
    for (int k = 0; k < count; ++k) {
        const double edge = block.edge_m[k];
        const auto way_along = [&](int axis) {
            const double place = block.cell[axis][k] + static_cast<double>(block.within[axis][k]);
            return place * edge - sonar.sensor[axis];
        };
        const double x = way_along(0);
        const double y = way_along(1);
        const double z = way_along(2);
        const double way = turns_per_m * piece_range(x, y, z);
        turns[k] = static_cast<float>(way - std::floor(way));
    }
}

}  // namespace

ScattererCells scatterer_cells(double resolution_m, double width_rad, double range_min_m,
                               double wavelength_m) {
    const double max_edge = max_of_resolution * resolution_m;
    const double per_root_range = std::sqrt(resolution_m * width_rad / scatterers_in_cell);
    const double min_edge = per_root_range * std::sqrt(std::max(range_min_m, 1e-3));
    ScattererCells out;
    out.levels = 1;
    double edge = max_edge;
    while (edge > min_edge && out.levels < 12) {
        edge *= 0.5;
        ++out.levels;
    }
    out.levels += steep_levels;
    out.min_edge_m = static_cast<float>(edge);
    out.edge_per_root_range = static_cast<float>(per_root_range);
    out.max_depth_m = static_cast<float>(max_edge);
    out.width_rad = static_cast<float>(width_rad);
    out.range_min_m = static_cast<float>(range_min_m - resolution_m);
    out.turns_per_m = 2.0 / wavelength_m;
    return out;
}

void draw_amplitudes(const Scatterers& block, const PointEchoes& echoes,
                     const ScattererCells& cells, const SonarInScene& sonar, PhiloxKey key,
                     Amplitudes& out) {
    Floats turns;
    Words for_strength, for_phase;
    const int count = echoes.count;
    name_cells(block, count, for_strength, for_phase);
    philox_pairs(for_strength.data(), for_phase.data(), count, key);
    find_phases(block, count, sonar, cells.turns_per_m, turns);
    Floats strength;
    for (int k = 0; k < count; ++k)
        strength[k] = -natural_log(unit_float(for_strength[k]));
    for (int k = 0; k < count; ++k) {
        const float amplitude = std::sqrt(echoes.power[k] * strength[k]);
        const SinCosFloat phase = sincos_turns(unit_float(for_phase[k]) + turns[k]);
        out.re[k] = amplitude * phase.cos;
        out.im[k] = amplitude * phase.sin;
    }
}

}  // namespace sonarsim
