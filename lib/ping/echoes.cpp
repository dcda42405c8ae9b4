#include "ping/echoes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ping/footprint.h"

namespace sonarsim {

namespace {

// A bin averages over its pieces; more of them than this change neither its mean nor its speckle by
// what can be seen (the contrast of a mean over 64 draws is an eighth of one draw's).
constexpr float most_pieces_per_bin = 64.0F;

// A piece has one intensity. On a plane v . n = H / r: where a piece spans no more than this share
// of its range, its ends are off by 1 % and its mean is right.
constexpr float most_depth_by_range = 0.02F;

constexpr int lanes = 8;

using Lanes = std::array<float, lanes>;

/// One coordinate of the scatterer cells at c + s u + t v.
void cells_along(float c, float u, float v, const Lanes& s, const Lanes& t,
                 std::int32_t* __restrict out) {
    for (int lane = 0; lane < lanes; ++lane) {
        out[lane] =
            static_cast<std::int32_t>(std::floor(std::fma(s[lane], u, std::fma(t[lane], v, c))));
    }
}

/// How far the range of a piece reaches before and after that of its centre.
struct Extent {
    float before;
    float after;
};

Extent operator+(const Extent& a, const Extent& b) {
    return {a.before + b.before, a.after + b.after};
}

/// Along a half edge e of depth d the range is r + d s + c s^2, s in [-1, 1], with
/// c = (e^2 - d^2) / (2 r): both ends lie farther than the depth says, and beside the foot of the
/// perpendicular there is no near end.
Extent extent_of(const Eigen::Vector3f& edge, float depth_m, float range_m) {
    const float bend = std::max(edge.squaredNorm() - depth_m * depth_m, 0.0F) / (2.0F * range_m);
    return {.before = depth_m >= 2.0F * bend ? depth_m - bend : 0.25F * depth_m * depth_m / bend,
            .after = depth_m + bend};
}

/// How a footprint is cut whose half edges span `depth_u_m` and `depth_v_m` of range.
Cut cut(const Sample& sample, float range_m, float depth_u_m, float depth_v_m, float bin_m,
        float cell_m) {
    if (cell_m > 0.0F) {
        const float bins = 2.0F + 2.0F * (depth_u_m + depth_v_m) / bin_m;
        return rounded_up(one_piece_per_cell(sample, cell_m, most_pieces_per_bin * bins));
    }
    // A box follows the edge that spans more range; the other edge is cut until a piece of it is
    // half a bin deep.
    const auto pieces = [](float depth_m, float most_m) {
        return std::clamp(2.0F * depth_m / most_m, 1.0F, most_pieces_per_bin);
    };
    const float across_m = 0.5F * bin_m;
    const float along_m = std::max(bin_m, most_depth_by_range * range_m);
    const Pieces wanted =
        depth_u_m < depth_v_m
            ? Pieces{.u = pieces(depth_u_m, across_m), .v = pieces(depth_v_m, along_m)}
            : Pieces{.u = 1.0F, .v = pieces(depth_v_m, across_m)};
    return rounded_up(wanted);
}

}  // namespace

void Echoes::resize(std::size_t count, bool cells) {
    range_m.resize(count);
    half_m.resize(count);
    weight.resize(count);
    intensity.resize(count);
    if (cells) {
        cell_x.resize(count);
        cell_y.resize(count);
        cell_z.resize(count);
    }
}

void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes) {
    const CellFrame cells(lattice);
    std::size_t end = 0;
    for (const Sample& sample : samples) {
        const float range = sample.position.norm();
        const Eigen::Vector3f out = sample.position / range;
        const float depth_u = std::fabs(out.dot(sample.edge_u));
        const float depth_v = std::fabs(out.dot(sample.edge_v));
        const Cut grid = cut(sample, range, depth_u, depth_v, bin_m, lattice.edge_m);
        const float u_step = 2.0F / static_cast<float>(grid.u);
        const float v_step = 2.0F / static_cast<float>(grid.v);
        const float per_column = 1.0F / static_cast<float>(grid.u);
        const float per_row = 1.0F / static_cast<float>(grid.v);
        const Extent extent = extent_of(sample.edge_u * per_column, depth_u * per_column, range) +
                              extent_of(sample.edge_v * per_row, depth_v * per_row, range);
        const float half = 0.5F * (extent.after + extent.before);
        const float shift = 0.5F * (extent.after - extent.before);
        const float weight = sample.area_m2 / static_cast<float>(grid.pieces());
        const float reflection = materials[sample.material].reflection;
        const float height = sample.height_m;
        const Eigen::Vector3f centre = sample.position;
        const Eigen::Vector3f edge_u = sample.edge_u;
        const Eigen::Vector3f edge_v = sample.edge_v;
        const Eigen::Vector3f cell = cells.rotation * sample.position + cells.base;
        const Eigen::Vector3f cell_u = cells.rotation * sample.edge_u;
        const Eigen::Vector3f cell_v = cells.rotation * sample.edge_v;
        const int count = grid.pieces();
        if (end + count + lanes > echoes.size()) {
            echoes.resize(2 * (end + count + lanes), lattice.exists());
        }
        // Whole vectors are written: the next sample overwrites the lanes after the last piece.
        for (int first = 0; first < count; first += lanes) {
            const std::size_t to = end + first;
            Lanes s;
            Lanes t;
            for (int lane = 0; lane < lanes; ++lane) {
                const float k = static_cast<float>(first + lane);
                const float row = std::floor((k + 0.5F) * per_row);
                s[lane] = (row + 0.5F) * u_step - 1.0F;
                t[lane] = (k - row * static_cast<float>(grid.v) + 0.5F) * v_step - 1.0F;
            }
            float* const __restrict range_m = echoes.range_m.data() + to;
            float* const __restrict intensity = echoes.intensity.data() + to;
            for (int lane = 0; lane < lanes; ++lane) {
                const float x =
                    std::fma(s[lane], edge_u.x(), std::fma(t[lane], edge_v.x(), centre.x()));
                const float y =
                    std::fma(s[lane], edge_u.y(), std::fma(t[lane], edge_v.y(), centre.y()));
                const float z =
                    std::fma(s[lane], edge_u.z(), std::fma(t[lane], edge_v.z(), centre.z()));
                const float r = std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
                range_m[lane] = r + shift;
                intensity[lane] = reflection * std::min(height / r, 1.0F);
            }
            std::fill_n(echoes.half_m.data() + to, lanes, half);
            std::fill_n(echoes.weight.data() + to, lanes, weight);
            if (!lattice.exists()) continue;
            cells_along(cell.x(), cell_u.x(), cell_v.x(), s, t, echoes.cell_x.data() + to);
            cells_along(cell.y(), cell_u.y(), cell_v.y(), s, t, echoes.cell_y.data() + to);
            cells_along(cell.z(), cell_u.z(), cell_v.z(), s, t, echoes.cell_z.data() + to);
        }
        end += count;
    }
    echoes.resize(end, lattice.exists());
}

}  // namespace sonarsim
