#include <utility>

#include "core/groups.h"
#include "simulate/paper/echoes.h"

namespace sonarsim {

namespace {

// Pieces along an edge of a footprint, and of its scatterer cells in one bin.
constexpr float max_pieces_per_edge = 64.0F;
constexpr float max_bounce_pieces_per_bin = 16.0F;

/// A part of a bounce in one beam and one scatterer cell.
struct Piece {
    std::uint32_t beam;
    std::uint32_t path;
    float range_m;
    float half_m;
    float weight;
    float intensity;
    CellName cell;
};

/// The pieces of a bounce: none is wider than a beam or, with range noise, a scatterer cell.
std::pair<int, int> cut(const BouncePath& b, const Sample& sample, float bin_m,
                        const ScattererLattice& lattice) {
    PieceCounts wanted{.u = 2.0F * std::fabs(b.beam_u), .v = 2.0F * std::fabs(b.beam_v)};
    if (lattice.exists()) {
        const float bins = (2.0F + 2.0F * (std::fabs(b.range_u) + std::fabs(b.range_v)) / bin_m) *
                           (1.0F + wanted.u + wanted.v);
        const PieceCounts cells =
            one_piece_per_cell(sample.edge_u.norm(), sample.edge_v.norm(), lattice.edge_m,
                               max_bounce_pieces_per_bin * bins);
        wanted = {.u = std::max(wanted.u, cells.u), .v = std::max(wanted.v, cells.v)};
    }
    const auto rounded_up = [](float pieces) {
        return static_cast<int>(std::ceil(std::clamp(pieces, 1.0F, max_pieces_per_edge)));
    };
    return {rounded_up(wanted.u), rounded_up(wanted.v)};
}

/// Adds the pieces of a bounce to `out`, without those outside the field of view.
void add_pieces(const BouncePath& b, std::uint32_t path, const Sample& sample, const View& view,
                const ScattererLattice& lattice, const CellFrame& cells, std::vector<Piece>& out) {
    const auto beams = static_cast<float>(view.beams);
    const bool full_turn = is_full_turn(view);
    const auto [n_u, n_v] = cut(b, sample, static_cast<float>(view.bin_m()), lattice);
    const float step_u = 1.0F / static_cast<float>(n_u);
    const float step_v = 1.0F / static_cast<float>(n_v);
    Piece piece{};
    piece.path = path;
    // The variance of the box is the sum of the variances of the two edges' boxes.
    piece.half_m = std::sqrt(b.range_u * b.range_u * step_u * step_u +
                             b.range_v * b.range_v * step_v * step_v);
    piece.weight = sample.area_m2 * step_u * step_v;
    piece.intensity = b.intensity;
    const Eigen::Vector3f centre = cells.rotation * sample.position + cells.base;
    const Eigen::Vector3f cell_u = cells.rotation * sample.edge_u;
    const Eigen::Vector3f cell_v = cells.rotation * sample.edge_v;
    std::size_t k = out.size();
    out.resize(k + static_cast<std::size_t>(n_u) * n_v);
    for (int i = 0; i < n_u; ++i) {
        const float s = (2.0F * static_cast<float>(i) + 1.0F) * step_u - 1.0F;
        const Eigen::Vector3f row = centre + s * cell_u;
        for (int j = 0; j < n_v; ++j) {
            const float t = (2.0F * static_cast<float>(j) + 1.0F) * step_v - 1.0F;
            float beam = b.beam + s * b.beam_u + t * b.beam_v;
            if (full_turn) beam = beam_in_turn(beam, beams);
            if (!(beam >= 0.0F && beam < beams)) continue;
            piece.beam = static_cast<std::uint32_t>(beam);
            piece.range_m = b.range_m + s * b.range_u + t * b.range_v;
            const auto cell_along = [&](int axis) {
                return static_cast<std::int32_t>(std::floor(row[axis] + t * cell_v[axis]));
            };
            piece.cell = cell_name(cell_along(0), cell_along(1), cell_along(2));
            out[k++] = piece;
        }
    }
    out.resize(k);
}

MultipathEchoes sorted_by_beam(const std::vector<Piece>& pieces, int beams, bool cells) {
    std::vector<std::uint32_t> beam(pieces.size());
    std::ranges::transform(pieces, beam.begin(), &Piece::beam);
    Groups groups = sort_into_groups(beam, beams);
    MultipathEchoes out;
    out.beam_begin = std::move(groups.begin);
    out.echoes.resize(pieces.size(), cells);
    out.path.resize(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece& piece = pieces[groups.items[k]];
        out.path[k] = piece.path;
        out.echoes.range_m[k] = piece.range_m;
        out.echoes.half_m[k] = piece.half_m;
        out.echoes.weight[k] = piece.weight;
        out.echoes.intensity[k] = piece.intensity;
        if (cells) {
            out.echoes.cell_low[k] = piece.cell.low;
            out.echoes.cell_high[k] = piece.cell.high;
        }
    }
    return out;
}

}  // namespace

MultipathEchoes multipath_echoes(std::span<const BouncePath> bounces, const Samples& samples,
                                 const View& view, const ScattererLattice& lattice) {
    std::vector<Piece> pieces;
    pieces.reserve(16 * bounces.size());
    const CellFrame cells(lattice);
    for (std::uint32_t k = 0; k < bounces.size(); ++k) {
        const BouncePath& b = bounces[k];
        if (!b.scattered) add_pieces(b, k, samples.items[b.sample], view, lattice, cells, pieces);
    }
    return sorted_by_beam(pieces, view.beams, lattice.exists());
}

}  // namespace sonarsim
