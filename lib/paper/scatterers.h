#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sonarsim {

/// The lattice of scatterer cells: world-aligned cubes. All surface in a cell shares one draw of
/// the range noise, so that the noise belongs to the scene and not to how it is sampled.
struct ScattererLattice {
    float edge_m = 0.0F;  ///< 0: no range noise, no cells
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3f sensor = Eigen::Vector3f::Zero();  ///< relative to Scene::origin, m

    bool exists() const { return edge_m > 0.0F; }
};

/// The name of a cell in its draw: the lowest 21 bits of its x and y and 22 of its z. Cells that
/// lie 2^21 edges apart share draws, 42 km at 2 cm.
struct CellName {
    std::uint32_t low, high;
};

inline CellName cell_name(std::int32_t x, std::int32_t y, std::int32_t z) {
    constexpr std::uint32_t bits_21 = 0x1FFFFF;
    const auto split = static_cast<std::uint32_t>(z);
    return {.low = (static_cast<std::uint32_t>(x) & bits_21) | split << 21,
            .high = (static_cast<std::uint32_t>(y) & bits_21) | split >> 11 << 21};
}

/// From the sensor frame to the cells of a lattice. Its constructor is inline so that loops that
/// write echoes keep it in registers: that of one in another file might have kept its address.
struct CellFrame {
    explicit CellFrame(const ScattererLattice& lattice) {
        // In cells. Planes of a scene often lie on round coordinates. Were faces of cells to
        // coincide with them, rounding would put neighbouring points into one cell or the other.
        const Eigen::Vector3f offset(0.381966F, 0.618034F, 0.272019F);
        const float per_cell = lattice.exists() ? 1.0F / lattice.edge_m : 0.0F;
        rotation = per_cell * lattice.R_world_sensor;
        base = per_cell * lattice.sensor + offset;
    }

    Eigen::Matrix3f rotation;  ///< cells per metre
    Eigen::Vector3f base;      ///< the sensor, in cells
};

}  // namespace sonarsim
