#pragma once

#include <Eigen/Core>

#include "core/random.h"

namespace sonarsim {

/// The lattice of scatterer cells: world-aligned cubes. All surface in a cell shares one draw of
/// the range noise, so that the noise belongs to the scene and not to how it is sampled.
struct ScattererLattice {
    float edge_m = 0.0F;  ///< 0: no range noise, no cells
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3f sensor = Eigen::Vector3f::Zero();  ///< relative to Scene::origin, m

    bool exists() const { return edge_m > 0.0F; }
};

/// The transform from the sensor frame to the cells of a lattice. Its constructor is inline, so
/// that loops that write echoes keep it in registers: a function in another file might keep its
/// address.
struct CellFrame {
    explicit CellFrame(const ScattererLattice& lattice) {
        // In cells. The offset keeps the faces of cells off round coordinates, on which planes of a
        // scene often lie: rounding would put neighbouring points of such a plane into different
        // cells.
        const Eigen::Vector3f offset(0.381966F, 0.618034F, 0.272019F);
        const float per_cell = lattice.exists() ? 1.0F / lattice.edge_m : 0.0F;
        rotation = per_cell * lattice.R_world_sensor;
        base = per_cell * lattice.sensor + offset;
    }

    Eigen::Matrix3f rotation;  ///< cells per metre
    Eigen::Vector3f base;      ///< the sensor, in cells
};

}  // namespace sonarsim
