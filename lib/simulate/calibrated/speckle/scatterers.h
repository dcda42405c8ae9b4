#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "core/random.h"
#include "simulate/calibrated/equation/sonar_equation.h"

namespace sonarsim {

/// The scatterers of a scene as one sonar resolves them: one to each cell of a world-aligned
/// lattice of cubes. A cell's scatterer has a place within the cell, a strength and a phase of its
/// own, all drawn from the cell's number. The edge of the cells doubles from one level to the next.
/// A scatterer represents many, so its strength is exponentially distributed.
struct ScattererCells {
    float min_edge_m = 0.0F;           ///< level 0
    float edge_per_root_range = 0.0F;  ///< m per sqrt(m), at grazing incidence
    float max_depth_m = 0.0F;          ///< greatest size of a cell in range
    float width_rad = 0.0F;            ///< width of a resolution cell
    float range_min_m = 0.0F;          ///< samples that are wholly nearer have no scatterers
    int levels = 1;
    double turns_per_m = 0.0;  ///< two-way phase: 2 / wavelength
};

/// At least four cells to a resolution cell of `resolution_m` in range and `width_rad` across, but
/// no longer in range than 1.25 times the resolution.
ScattererCells scatterer_cells(double resolution_m, double width_rad, double range_min_m,
                               double wavelength_m);

struct SonarInScene {
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< relative to Scene::origin, m
};

/// A block of scatterers: pieces of surface of the size of their cells, the cells' numbers, and the
/// scatterers' places within them, in edges; along x, y and z of the world.
struct Scatterers {
    PatchBlock pieces;
    PatchBlock::Array<float> edge_m{};
    std::array<PatchBlock::Array<std::int32_t>, 3> cell{};
    std::array<PatchBlock::Array<float>, 3> within{};
};

void draw_amplitudes(const Scatterers& block, const PointEchoes& echoes,
                     const ScattererCells& cells, const SonarInScene& sonar, PhiloxKey key,
                     Amplitudes& out);

/// Finds the scatterers that lie on samples and hands them to `use`, a block at a time. In the
/// projection along the axis of the world that a sample faces most, every cell has one point, drawn
/// from its number and the key. The sample that covers the point holds the scatterer, so a surface
/// has the same scatterers however it is cut into samples. `shape`: that of the view.
void find_scatterers(std::span<const Sample> samples, ViewShape shape, const ScattererCells& cells,
                     const SonarInScene& sonar, PhiloxKey key, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use);

/// Points with amplitudes. Their areas are cross-sections, and they face the sonar.
struct PointScatterers {
    std::vector<Sample> points;
    std::vector<float> turns;  ///< the phase of each of its own, in turns
};

/// Joins the pieces of targets to scatterers, each with one phase.
///
/// The pieces of one smooth surface of a target that lie within a cell make one scatterer. The
/// cells are counted from the middle of the highlight, where facets face the sonar. So a highlight
/// smaller than a cell is one scatterer, at its place, with the highlight's energy, and does not
/// flicker as the sonar moves. The scatterers of a larger highlight, and those of other surface,
/// have exponential strengths; the transition is gradual. A scatterer keeps its draws.
///
/// `pieces`: surface after surface. `cell`: its size.
PointScatterers join_targets(std::span<const Sample> pieces, ViewShape shape,
                             const PointLimits& cell, const Scattering& scattering, PhiloxKey key);

}  // namespace sonarsim
