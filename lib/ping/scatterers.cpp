#include "ping/scatterers.h"

namespace sonarsim {

namespace {

// In cells. Planes of a scene often lie on round coordinates. Were faces of cells to coincide with
// them, rounding would put neighbouring points into one cell or the other.
const Eigen::Vector3f lattice_offset(0.381966F, 0.618034F, 0.272019F);

}  // namespace

CellFrame::CellFrame(const ScattererLattice& lattice) {
    const float per_cell = lattice.exists() ? 1.0F / lattice.edge_m : 0.0F;
    rotation = per_cell * lattice.R_world_sensor;
    base = per_cell * lattice.sensor + lattice_offset;
}

}  // namespace sonarsim
