#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The echoes of one beam, one entry per piece of surface. Arrays, so that loops vectorise.
struct Echoes {
    std::vector<float> range_m;                        ///< slant range of the piece's centre
    std::vector<float> half_m;                         ///< half its extent in range
    std::vector<float> weight;                         ///< the area that it stands for, m^2
    std::vector<float> intensity;                      ///< [6]
    std::vector<std::int32_t> cell_x, cell_y, cell_z;  ///< scatterer cell, when there is noise

    std::size_t size() const { return range_m.size(); }
    void resize(std::size_t count, bool cells);
};

/// The lattice of scatterer cells: world-aligned cubes, in which each draws its own range noise.
struct ScattererLattice {
    float edge_m = 0.0F;  ///< 0: no range noise, no cells
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3f sensor = Eigen::Vector3f::Zero();  ///< relative to Scene::origin, m

    bool exists() const { return edge_m > 0.0F; }
};

/// From the sensor frame to the cells of a lattice.
struct CellFrame {
    explicit CellFrame(const ScattererLattice& lattice);

    Eigen::Matrix3f rotation;  ///< cells per metre
    Eigen::Vector3f base;      ///< the sensor, in cells
};

/// Turns the samples of a beam into echoes, I = R (v . n) [6]. A sample whose footprint covers
/// more than its bins or its scatterer cells can tell apart is cut into pieces: in range the box
/// over [range - half, range + half] stands for each of them.
void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes);

}  // namespace sonarsim
