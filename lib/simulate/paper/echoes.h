#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "input/scene/scene.h"
#include "simulate/trace/multipath.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The lattice of scatterer cells: world-aligned cubes. All surface in a cell shares one draw of
/// the range noise, so that the noise belongs to the scene and not to how it is sampled.
struct ScattererLattice {
    float edge_m = 0.0F;  ///< 0: no range noise, no cells
    Eigen::Matrix3f R_world_sensor = Eigen::Matrix3f::Identity();
    Eigen::Vector3f sensor = Eigen::Vector3f::Zero();  ///< relative to Scene::origin, m

    bool exists() const { return edge_m > 0.0F; }
};

/// The transform from the sensor frame to the cells of a lattice; inline, to stay in registers.
struct CellFrame {
    explicit CellFrame(const ScattererLattice& lattice) {
        // In cells. The offset keeps the faces of cells off round coordinates, on which planes of a
        // scene often lie: rounding would divide such a plane between two cells.
        const Eigen::Vector3f offset(0.381966F, 0.618034F, 0.272019F);
        const float per_cell = lattice.exists() ? 1.0F / lattice.edge_m : 0.0F;
        rotation = per_cell * lattice.R_world_sensor;
        base = per_cell * lattice.sensor + offset;
    }

    Eigen::Matrix3f rotation;  ///< cells per metre
    Eigen::Vector3f base;      ///< the sensor, in cells
};

/// Echoes of the paper's model: their weights are areas.
struct Echoes : RangeBoxes {
    std::vector<std::uint32_t> cell_low, cell_high;  ///< CellName, when there is noise

    void resize(std::size_t count, bool cells);
};

/// Turns the samples of a beam into echoes of intensity I = R (v . n), Eq. 4-6. A footprint that
/// spans several bins or scatterer cells is cut into pieces, each of them an echo that is spread
/// evenly over [range - half, range + half]. `ends`: the end of each sample's echoes, if wanted.
void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes,
                   std::vector<std::uint32_t>* ends = nullptr);

/// Pieces along either edge of a patch, at least 1.
struct PieceCounts {
    float u;
    float v;
};

/// One piece per scatterer cell of edge `cell_m` that a footprint with half edges of length `u_m`
/// and `v_m` spans, before rounding to whole numbers. At most `max_pieces` in all.
inline PieceCounts one_piece_per_cell(float u_m, float v_m, float cell_m, float max_pieces) {
    const float u = std::max(2.0F * u_m / cell_m, 1.0F);
    const float v = std::max(2.0F * v_m / cell_m, 1.0F);
    const float shrink = 1.0F / std::sqrt(std::max(u * v / max_pieces, 1.0F));
    return {.u = std::max(u * shrink, 1.0F), .v = std::max(v * shrink, 1.0F)};
}

struct MultipathEchoes {
    Echoes echoes;                          ///< sorted by beam
    std::vector<std::uint32_t> beam_begin;  ///< beams + 1 offsets into `echoes`
    std::vector<std::uint32_t> path;        ///< index into the paths, by echo
};

/// Turns the paths that are not scattered into echoes with the weight and the scatterer cells of
/// their samples. A footprint that spans several beams or cells is cut into pieces.
MultipathEchoes multipath_echoes(std::span<const BouncePath> bounces, const Samples& samples,
                                 const View& view, const ScattererLattice& lattice);

}  // namespace sonarsim
