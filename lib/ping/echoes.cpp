#include "ping/echoes.h"

#include <algorithm>
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

// A piece has one intensity. Over it v . n may change by a twentieth of itself, so that the ends
// are 2.5 % off and the average is right; on a plane, where v . n = H / r, that is a twentieth of
// r.
constexpr float finest_change = 0.02F;

/// How many pieces a footprint is cut into along its two edges.
Cut cut(const Sample& sample, float slope_u, float slope_v, float bin_m, float cell_m) {
    if (cell_m <= 0.0F) {
        // A box follows the edge that spans more range; the other edge is cut until a piece of it
        // is half a bin deep.
        const auto pieces = [&](float slope, float most_m) {
            return static_cast<int>(
                std::ceil(std::clamp(2.0F * slope / most_m, 1.0F, pieces_per_bin)));
        };
        const float across = 0.5F * bin_m;
        const float change = 2.0F * std::fabs(sample.cosine_v) / (finest_change * sample.cosine);
        const float along = std::max(bin_m, 2.0F * slope_v / std::max(change, 1.0F));
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
        const Cut pieces = cut(sample, slope_u, slope_v, bin_m, lattice.edge_m);
        const float u_step = 2.0F / static_cast<float>(pieces.u);
        const float v_step = 2.0F / static_cast<float>(pieces.v);
        const float half = std::max(slope_u / static_cast<float>(pieces.u),
                                    slope_v / static_cast<float>(pieces.v));
        const float weight = sample.area_m2 / static_cast<float>(pieces.u * pieces.v);
        const float reflection = materials[sample.material].reflection;
        const std::size_t begin = end;
        end += static_cast<std::size_t>(pieces.u) * pieces.v;
        if (end > echoes.size()) echoes.resize(2 * end, lattice.exists());
        std::size_t k = begin;
        for (int a = 0; a < pieces.u; ++a) {
            const Eigen::Vector3f row =
                sample.position + ((a + 0.5F) * u_step - 1.0F) * sample.edge_u;
            const Eigen::Vector3f cell_row = cells.rotation * row + cells.base;
            const Eigen::Vector3f cell_edge = cells.rotation * sample.edge_v;
            for (int b = 0; b < pieces.v; ++b, ++k) {
                const float t = (static_cast<float>(b) + 0.5F) * v_step - 1.0F;
                const float x = row.x() + t * sample.edge_v.x();
                const float y = row.y() + t * sample.edge_v.y();
                const float z = row.z() + t * sample.edge_v.z();
                const float r = std::sqrt(x * x + y * y + z * z);
                echoes.range_m[k] = r;
                echoes.half_m[k] = half;
                echoes.weight[k] = weight;
                echoes.intensity[k] = reflection * (sample.cosine + t * sample.cosine_v);
                if (lattice.exists()) {
                    echoes.cell_x[k] =
                        static_cast<std::int32_t>(std::floor(cell_row.x() + t * cell_edge.x()));
                    echoes.cell_y[k] =
                        static_cast<std::int32_t>(std::floor(cell_row.y() + t * cell_edge.y()));
                    echoes.cell_z[k] =
                        static_cast<std::int32_t>(std::floor(cell_row.z() + t * cell_edge.z()));
                }
            }
        }
    }
    echoes.resize(end, lattice.exists());
}

}  // namespace sonarsim
