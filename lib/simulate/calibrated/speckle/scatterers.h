#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

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
    int levels = 1;
    double turns_per_m = 0.0;  ///< two-way phase: 2 / wavelength
};

/// At least four cells to a resolution cell of `resolution_m` in range and `width_rad` across, but
/// no longer in range than 1.25 times the resolution.
ScattererCells scatterer_cells(double resolution_m, double width_rad, double range_min_m,
                               double wavelength_m);

/// The pose of the sonar among the cells.
struct SonarInScene {
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< relative to Scene::origin, m
};

/// The places of pieces in the world, relative to Scene::origin, m.
struct WorldPlaces {
    PatchBlock::Array<float> x, y, z;
};
void find_places(const PatchBlock& pieces, int count, const SonarInScene& sonar, WorldPlaces& out);

/// A block of scatterers: pieces of surface of the size of their cells, the cells' numbers, and the
/// scatterers' places within them, in edges; along x, y and z of the world.
struct Scatterers {
    PatchBlock pieces;
    PatchBlock::Array<float> edge_m{};
    std::array<PatchBlock::Array<std::int32_t>, 3> cell{};
    std::array<PatchBlock::Array<float>, 3> within{};
};

/// The complex amplitudes of a block's echoes.
void draw_amplitudes(const Scatterers& block, const PointEchoes& echoes,
                     const ScattererCells& cells, const SonarInScene& sonar, PhiloxKey key,
                     Amplitudes& out);

}  // namespace sonarsim
