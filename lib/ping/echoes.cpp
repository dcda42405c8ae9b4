#include "ping/echoes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sonarsim {

namespace {

// A bin averages over its pieces; beyond this many, more of them change neither its mean nor its
// speckle by what can be seen (the contrast of a mean over 64 draws is an eighth of one draw's).
constexpr float pieces_per_bin = 64.0F;

// Scene planes like to lie on round coordinates. Cell faces that coincide with them would hand
// neighbouring points to one cell or the other by rounding; these offsets keep them apart.
const Eigen::Vector3f lattice_offset(0.381966F, 0.618034F, 0.272019F);

struct Cut {
    int u;
    int v;
};

// A piece has one intensity. On a plane v . n = H / r: where a piece spans no more than this share
// of its range, its ends are off by 1 % and its mean is right.
constexpr float deepest_piece = 0.02F;

constexpr int lanes = 8;

using Lanes = std::array<float, lanes>;

/// One coordinate of the cells at c + s u + t v.
void cells_along(float c, float u, float v, const Lanes& s, const Lanes& t,
                 std::int32_t* __restrict out) {
    for (int lane = 0; lane < lanes; ++lane) {
        out[lane] = static_cast<std::int32_t>(std::floor(c + s[lane] * u + t[lane] * v));
    }
}

/// How many pieces a footprint is cut into along its two edges.
Cut cut(const Sample& sample, float range, float slope_u, float slope_v, float bin_m,
        float cell_m) {
    if (cell_m <= 0.0F) {
        // A box follows the edge that spans more range; the other edge is cut until a piece of it
        // is half a bin deep.
        const auto pieces = [&](float slope, float most_m) {
            return static_cast<int>(
                std::ceil(std::clamp(2.0F * slope / most_m, 1.0F, pieces_per_bin)));
        };
        const float across = 0.5F * bin_m;
        const float along = std::max(bin_m, deepest_piece * range);
        return slope_u < slope_v ? Cut{pieces(slope_u, across), pieces(slope_v, along)}
                                 : Cut{1, pieces(slope_v, across)};
    }
    float u = std::max(2.0F * sample.edge_u.norm() / cell_m, 1.0F);
    float v = std::max(2.0F * sample.edge_v.norm() / cell_m, 1.0F);
    const float bins = 2.0F + 2.0F * (slope_u + slope_v) / bin_m;
    const float excess = u * v / (pieces_per_bin * bins);
    if (excess > 1.0F) {
        const float shrink = 1.0F / std::sqrt(excess);
        u = std::max(u * shrink, 1.0F);
        v = std::max(v * shrink, 1.0F);
    }
    return {static_cast<int>(std::ceil(u)), static_cast<int>(std::ceil(v))};
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

CellFrame::CellFrame(const ScattererLattice& lattice) {
    const float per_cell = lattice.exists() ? 1.0F / lattice.edge_m : 0.0F;
    rotation = per_cell * lattice.R_world_sensor;
    base = per_cell * lattice.sensor + lattice_offset;
}

void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes) {
    const CellFrame cells(lattice);
    std::size_t end = 0;
    for (const Sample& sample : samples) {
        const float range = sample.position.norm();
        const Eigen::Vector3f out = sample.position / range;
        const float slope_u = std::fabs(out.dot(sample.edge_u));
        const float slope_v = std::fabs(out.dot(sample.edge_v));
        const Cut pieces = cut(sample, range, slope_u, slope_v, bin_m, lattice.edge_m);
        const float u_step = 2.0F / static_cast<float>(pieces.u);
        const float v_step = 2.0F / static_cast<float>(pieces.v);
        const float half = std::max(slope_u / static_cast<float>(pieces.u),
                                    slope_v / static_cast<float>(pieces.v));
        const float weight = sample.area_m2 / static_cast<float>(pieces.u * pieces.v);
        const float reflection = materials[sample.material].reflection;
        const float height = sample.height_m;
        const Eigen::Vector3f centre = sample.position;
        const Eigen::Vector3f edge_u = sample.edge_u;
        const Eigen::Vector3f edge_v = sample.edge_v;
        const float per_row = 1.0F / static_cast<float>(pieces.v);
        const Eigen::Vector3f cell = cells.rotation * sample.position + cells.base;
        const Eigen::Vector3f cell_u = cells.rotation * sample.edge_u;
        const Eigen::Vector3f cell_v = cells.rotation * sample.edge_v;
        const int count = pieces.u * pieces.v;
        if (end + count + lanes > echoes.size()) {
            echoes.resize(2 * (end + count + lanes), lattice.exists());
        }
        // Whole vectors are written; what lies beyond the last piece is overwritten by the next
        // sample.
        for (int first = 0; first < count; first += lanes) {
            const std::size_t to = end + first;
            Lanes s;
            Lanes t;
            for (int lane = 0; lane < lanes; ++lane) {
                const float k = static_cast<float>(first + lane);
                const float row = std::floor((k + 0.5F) * per_row);
                s[lane] = (row + 0.5F) * u_step - 1.0F;
                t[lane] = (k - row * static_cast<float>(pieces.v) + 0.5F) * v_step - 1.0F;
            }
            float* const __restrict range_m = echoes.range_m.data() + to;
            float* const __restrict intensity = echoes.intensity.data() + to;
            for (int lane = 0; lane < lanes; ++lane) {
                const float x = centre.x() + s[lane] * edge_u.x() + t[lane] * edge_v.x();
                const float y = centre.y() + s[lane] * edge_u.y() + t[lane] * edge_v.y();
                const float z = centre.z() + s[lane] * edge_u.z() + t[lane] * edge_v.z();
                range_m[lane] = std::sqrt(x * x + y * y + z * z);
                intensity[lane] = reflection * std::min(height / range_m[lane], 1.0F);
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
