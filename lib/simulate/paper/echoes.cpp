#include "simulate/paper/echoes.h"

#include <array>
#include <limits>

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// A block of samples, and how they are cut into pieces. Arrays, so that loops vectorise.
struct Footprints {
    static constexpr int capacity = 64;
    using Floats = std::array<float, capacity>;
    using Vectors = std::array<Floats, 3>;  ///< x, y, z

    int count = 0;  ///< number of samples, rounded up to whole vectors with the last sample
    Vectors position, edge_u, edge_v;  ///< m, sensor frame
    Floats height_m, area_m2, reflection;
    Vectors cell, cell_u, cell_v;  ///< the same in scatterer cells, if there is noise

    Floats range_m, depth_u_m, depth_v_m;  ///< centre; extents in range of half edges
    Floats u, v;                           ///< whole numbers: pieces along either edge
    Floats half_m;                         ///< half the extent of a piece in range
    Floats shift_m;  ///< middle of that extent, relative to the centre of the piece
    Floats weight;   ///< area of a piece, m^2
    Floats last_m;   ///< range of a wedge's farthest corner; no limit for other footprints
};

// Pieces of a bin: the contrast of a mean over 64 draws is an eighth of one draw's.
constexpr float max_pieces_per_bin = 64.0F;

/// The squared length of (x, y, z) in the order in which Eigen adds.
float squared(float x, float y, float z) {
    return x * x + (y * y + z * z);
}

constexpr float no_limit = std::numeric_limits<float>::max();

/// The range of the farthest corner. A wedge has corners +-u +- (1 +- wedge) v from its middle.
float last_range(const Sample& sample) {
    if (sample.wedge == 0.0F) return no_limit;
    float last_m = 0.0F;
    for (const float side : {-1.0F, 1.0F}) {
        const Eigen::Vector3f end = sample.middle() + side * sample.edge_u;
        const Eigen::Vector3f half = (1.0F + side * sample.wedge) * sample.edge_v;
        last_m = std::max({last_m, arrival_range(end - half), arrival_range(end + half)});
    }
    return last_m;
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
        f.last_m[k] = last_range(sample);
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

/// The pieces of a patch whose half edges are `depth_u_m` and `depth_v_m` deep. Each piece is
/// represented by a box in range. The edge that spans more range is cut into pieces a bin deep, or
/// deeper at long range; the other edge, into pieces half a bin deep.
PieceCounts pieces_for_bins(float depth_u_m, float depth_v_m, float range_m, float bin_m) {
    // More pieces than this do not change the mean of a bin visibly.
    constexpr float max_pieces = 64.0F;
    // A piece has one intensity, but v . n = H / r on a plane: its ends are off by half of this.
    constexpr float max_depth_by_range = 0.005F;
    const float along_m = std::max(bin_m, max_depth_by_range * range_m);
    const float across_m = 0.5F * bin_m;
    const bool along_v = depth_u_m < depth_v_m;
    const float u = along_v ? 2.0F * depth_u_m / across_m : 1.0F;
    const float v = 2.0F * depth_v_m / (along_v ? along_m : across_m);
    return {.u = std::ceil(std::min(std::max(u, 1.0F), max_pieces)),
            .v = std::ceil(std::min(std::max(v, 1.0F), max_pieces))};
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

/// Makes the footprints of at most `Footprints::capacity` samples and cuts them: into one piece per
/// scatterer cell or, without cells, so that no piece is deeper than the bins resolve.
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

constexpr int lanes = 8;

constexpr std::array<float, lanes> lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};

std::int32_t whole(float x) {
    return static_cast<std::int32_t>(std::floor(x));
}

/// c + s u + t v of footprint k, along one axis.
float along(const Footprints::Vectors& c, const Footprints::Vectors& u,
            const Footprints::Vectors& v, int axis, std::size_t k, float s, float t) {
    return std::fma(s, u[axis][k], std::fma(t, v[axis][k], c[axis][k]));
}

/// Cuts the extents of echoes at `first_m` and `last_m`: the pieces of a wedge are those of its
/// parallelogram, and no point of a plane is nearer than its foot.
void cut_at(float first_m, float last_m, float* range_m, float* half_m) {
    for (int k = 0; k < lanes; ++k) {
        // No std::clamp: rounding may put the foot behind the last corner.
        const float first = std::min(std::max(range_m[k] - half_m[k], first_m), last_m);
        const float last = std::min(std::max(range_m[k] + half_m[k], first_m), last_m);
        range_m[k] = 0.5F * (first + last);
        half_m[k] = 0.5F * (last - first);
    }
}

/// Writes the echoes of footprint k, of `count` pieces, from number `begin` on, and 7 lanes more.
void write_pieces(const Footprints& f, std::size_t k, int count, bool cells, std::size_t begin,
                  Echoes& to) {
    const float row_length = f.v[k];
    const float per_row = 1.0F / row_length;
    const float u_step = 2.0F / f.u[k];
    const float v_step = 2.0F / row_length;
    const float shift = f.shift_m[k];
    const float height = f.height_m[k];
    const float reflection = f.reflection[k];
    const bool is_cut =
        f.last_m[k] < no_limit || f.range_m[k] - f.depth_u_m[k] - f.depth_v_m[k] < height;
    for (int first = 0; first < count; first += lanes) {
        const std::size_t at = begin + first;
        std::array<float, lanes> s, t;
        const auto start = static_cast<float>(first);
        for (int lane = 0; lane < lanes; ++lane) {
            const float piece = start + lane_numbers[lane];
            const float row = std::floor((piece + 0.5F) * per_row);
            s[lane] = (row + 0.5F) * u_step - 1.0F;
            t[lane] = (piece - row * row_length + 0.5F) * v_step - 1.0F;
        }
        float* const __restrict range_m = to.range_m.data() + at;
        float* const __restrict intensity = to.intensity.data() + at;
        for (int lane = 0; lane < lanes; ++lane) {
            const float x = along(f.position, f.edge_u, f.edge_v, 0, k, s[lane], t[lane]);
            const float y = along(f.position, f.edge_u, f.edge_v, 1, k, s[lane], t[lane]);
            const float z = along(f.position, f.edge_u, f.edge_v, 2, k, s[lane], t[lane]);
            const float r = piece_range(x, y, z);
            range_m[lane] = r + shift;
            intensity[lane] = reflection * std::min(height / r, 1.0F);
        }
        std::fill_n(to.half_m.data() + at, lanes, f.half_m[k]);
        if (is_cut) cut_at(height, f.last_m[k], range_m, to.half_m.data() + at);
        std::fill_n(to.weight.data() + at, lanes, f.weight[k]);
        if (!cells) continue;
        std::uint32_t* const __restrict low = to.cell_low.data() + at;
        std::uint32_t* const __restrict high = to.cell_high.data() + at;
        for (int lane = 0; lane < lanes; ++lane) {
            const CellName name =
                cell_name(whole(along(f.cell, f.cell_u, f.cell_v, 0, k, s[lane], t[lane])),
                          whole(along(f.cell, f.cell_u, f.cell_v, 1, k, s[lane], t[lane])),
                          whole(along(f.cell, f.cell_u, f.cell_v, 2, k, s[lane], t[lane])));
            low[lane] = name.low;
            high[lane] = name.high;
        }
    }
}

}  // namespace

void Echoes::resize(std::size_t count, bool cells) {
    RangeBoxes::resize(count);
    if (cells) {
        cell_low.resize(count);
        cell_high.resize(count);
    }
}

void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes,
                   std::vector<std::uint32_t>* ends) {
    if (ends) ends->clear();
    const bool named = lattice.exists();
    std::size_t end = 0;
    Footprints footprints;
    for (std::size_t begin = 0; begin < samples.size(); begin += Footprints::capacity) {
        const auto block = samples.subspan(
            begin, std::min<std::size_t>(Footprints::capacity, samples.size() - begin));
        cut_footprints(block, materials, bin_m, lattice, footprints);
        for (std::size_t k = 0; k < block.size(); ++k) {
            const int count = static_cast<int>(footprints.u[k] * footprints.v[k]);
            // write_pieces() writes whole vectors: the next sample overwrites the surplus lanes.
            if (end + count + lanes > echoes.size()) {
                echoes.resize(2 * (end + count + lanes), named);
            }
            write_pieces(footprints, k, count, named, end, echoes);
            end += count;
            if (ends) ends->push_back(static_cast<std::uint32_t>(end));
        }
    }
    echoes.resize(end, named);
}

}  // namespace sonarsim
