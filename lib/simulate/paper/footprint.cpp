#include "simulate/paper/footprint.h"

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

// Pieces of a bin: the contrast of a mean over 64 draws is an eighth of one draw's.
constexpr float max_pieces_per_bin = 64.0F;

/// The squared length of (x, y, z) in the order in which Eigen adds.
float squared(float x, float y, float z) {
    return x * x + (y * y + z * z);
}

void load(std::span<const Sample> samples, std::span<const Material> materials, Footprints& f) {
    constexpr std::size_t whole = 8;
    const std::size_t count = (samples.size() + whole - 1) / whole * whole;
    f.count = static_cast<int>(count);
    for (std::size_t k = 0; k < count; ++k) {
        const Sample& sample = samples[std::min(k, samples.size() - 1)];
        for (int axis = 0; axis < 3; ++axis) {
            f.position[axis][k] = sample.position[axis];
            f.edge_u[axis][k] = sample.edge_u[axis];
            f.edge_v[axis][k] = sample.edge_v[axis];
        }
        f.height_m[k] = sample.height_m;
        f.area_m2[k] = sample.area_m2;
        f.reflection[k] = materials[sample.material].reflection * sample.strength;
    }
}

/// out = M in + base.
void transform(const Eigen::Matrix3f& M, const Eigen::Vector3f& base, int count,
               const Footprints::Vectors& in, Footprints::Vectors& out) {
    for (int axis = 0; axis < 3; ++axis) {
        const float mx = M(axis, 0);
        const float my = M(axis, 1);
        const float mz = M(axis, 2);
        const float b = base[axis];
        for (int k = 0; k < count; ++k) {
            out[axis][k] =
                std::fma(mx, in[0][k], std::fma(my, in[1][k], std::fma(mz, in[2][k], b)));
        }
    }
}

void find_depths(Footprints& f) {
    const int count = f.count;
    for (int k = 0; k < count; ++k) {
        const auto [range, x, y, z] =
            arrival_at(f.position[0][k], f.position[1][k], f.position[2][k]);
        f.range_m[k] = range;
        f.depth_u_m[k] = std::fabs(x * f.edge_u[0][k] + (y * f.edge_u[1][k] + z * f.edge_u[2][k]));
        f.depth_v_m[k] = std::fabs(x * f.edge_v[0][k] + (y * f.edge_v[1][k] + z * f.edge_v[2][k]));
    }
}

/// Cuts footprints into pieces no larger than a scatterer cell.
void cut_for_cells(float bin_m, float cell_m, Footprints& f) {
    const int count = f.count;
    for (int k = 0; k < count; ++k) {
        const float u_m = std::sqrt(squared(f.edge_u[0][k], f.edge_u[1][k], f.edge_u[2][k]));
        const float v_m = std::sqrt(squared(f.edge_v[0][k], f.edge_v[1][k], f.edge_v[2][k]));
        const float bins = 2.0F + 2.0F * (f.depth_u_m[k] + f.depth_v_m[k]) / bin_m;
        const PieceCounts wanted = one_piece_per_cell(u_m, v_m, cell_m, max_pieces_per_bin * bins);
        f.u[k] = std::ceil(wanted.u);
        f.v[k] = std::ceil(wanted.v);
    }
}

void cut_for_bins(float bin_m, Footprints& f) {
    const int count = f.count;
    for (int k = 0; k < count; ++k) {
        const PieceCounts pieces =
            pieces_for_bins(f.depth_u_m[k], f.depth_v_m[k], f.range_m[k], bin_m);
        f.u[k] = pieces.u;
        f.v[k] = pieces.v;
    }
}

void find_extents(Footprints& f) {
    const int count = f.count;
    for (int k = 0; k < count; ++k) {
        const float u = 1.0F / f.u[k];
        const float v = 1.0F / f.v[k];
        const float edge_u = squared(f.edge_u[0][k] * u, f.edge_u[1][k] * u, f.edge_u[2][k] * u);
        const float edge_v = squared(f.edge_v[0][k] * v, f.edge_v[1][k] * v, f.edge_v[2][k] * v);
        const RangeExtent along_u = extent_of(edge_u, f.depth_u_m[k] * u, f.range_m[k]);
        const RangeExtent along_v = extent_of(edge_v, f.depth_v_m[k] * v, f.range_m[k]);
        const float before = along_u.before + along_v.before;
        const float after = along_u.after + along_v.after;
        f.half_m[k] = 0.5F * (after + before);
        f.shift_m[k] = 0.5F * (after - before);
        f.weight[k] = f.area_m2[k] / (f.u[k] * f.v[k]);
    }
}

}  // namespace

void cut_footprints(std::span<const Sample> samples, std::span<const Material> materials,
                    float bin_m, const ScattererLattice& lattice, Footprints& footprints) {
    load(samples, materials, footprints);
    find_depths(footprints);
    if (lattice.exists()) {
        const CellFrame cells(lattice);
        const Eigen::Vector3f none = Eigen::Vector3f::Zero();
        transform(cells.rotation, cells.base, footprints.count, footprints.position,
                  footprints.cell);
        transform(cells.rotation, none, footprints.count, footprints.edge_u, footprints.cell_u);
        transform(cells.rotation, none, footprints.count, footprints.edge_v, footprints.cell_v);
        cut_for_cells(bin_m, lattice.edge_m, footprints);
    } else {
        cut_for_bins(bin_m, footprints);
    }
    find_extents(footprints);
}

}  // namespace sonarsim
