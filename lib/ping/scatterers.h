#pragma once

#include <Eigen/Core>

namespace sonarsim {

/// The lattice of scatterer cells: world-aligned cubes. All surface in a cell shares one draw of
/// the range noise, so that the noise belongs to the scene and not to how it is sampled.
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

}  // namespace sonarsim
