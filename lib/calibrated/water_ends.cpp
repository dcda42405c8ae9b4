#include <algorithm>

#include "calibrated/patches.h"
#include "calibrated/water_column.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// Share of a cell's solid angle that closes it: pieces count for the cell of their middle.
constexpr float min_cover = 0.2F;

/// Sums over the pieces of surface in each cell. Pieces are collected, since finding their cells is
/// faster for many at a time.
class CoveredCells {
  public:
    explicit CoveredCells(const SightCells& cells)
        : cells_(cells), covered_sr_(cells.count(), 0.0F), weighted_m_(cells.count(), 0.0F) {}

    void add(std::span<const Sample> surface) {
        for (const Sample& sample : surface) {
            const auto [range, direction] = arrival_of(sample.position);
            if (!(range > 0.0F)) continue;
            const int rows = cells_.spanned(sample.edge_u, direction, range);
            const int columns = cells_.spanned(sample.edge_v, direction, range);
            const float covers = sample.area_m2 * sample.height_m / static_cast<float>(rows) /
                                 static_cast<float>(columns);
            for_each_middle(rows, columns, [&](float s, float t) {
                add(sample.position + s * sample.edge_u + t * sample.edge_v, covers);
            });
        }
    }

    /// The mean range of each cell that is closed.
    std::vector<float> ends() {
        flush();
        std::vector<float> out(cells_.count());
        for (int cell = 0; cell < cells_.count(); ++cell) {
            const bool closed = covered_sr_[cell] > min_cover * cells_.visible_sr[cell];
            out[cell] = closed ? weighted_m_[cell] / covered_sr_[cell] : no_end;
        }
        return out;
    }

  private:
    /// `covers`: the area across the line of sight, times the range.
    void add(const Eigen::Vector3f& place, float covers) {
        if (places_.count == SightPlaces::most) flush();
        const int at = places_.count++;
        places_.x[at] = place.x();
        places_.y[at] = place.y();
        places_.z[at] = place.z();
        covers_[at] = covers;
    }

    void flush() {
        cells_.find(places_);
        for (int k = 0; k < places_.count; ++k) {
            const int cell = places_.cell[k];
            if (cell < 0) continue;
            const float r = places_.range_m[k];
            covered_sr_[cell] += covers_[k] / (r * r * r);
            weighted_m_[cell] += covers_[k] / (r * r);
        }
        places_.count = 0;
    }

    const SightCells& cells_;
    std::vector<float> covered_sr_, weighted_m_;
    SightPlaces places_;
    std::array<float, SightPlaces::most> covers_{};
};

/// The view cuts cells at its border, and the middles of pieces of surface lie farther inside. So
/// the water of a cut cell without a piece ends where it does in the neighbours with more of their
/// area in the view.
void end_at_borders(const SightCells& cells, std::vector<float>& ends) {
    const std::vector<float> found = ends;
    for (int cell = 0; cell < cells.count(); ++cell) {
        const float seen = cells.visible_sr[cell];
        if (found[cell] != no_end || seen == 0.0F) continue;
        const int turn = cell % cells.turns;
        const auto take = [&](bool exists, int neighbour) {
            if (!exists || cells.visible_sr[neighbour] <= seen) return;
            ends[cell] = std::min(ends[cell], found[neighbour]);
        };
        take(turn > 0, cell - 1);
        take(turn + 1 < cells.turns, cell + 1);
        take(cell >= cells.turns, cell - cells.turns);
        take(cell + cells.turns < cells.count(), cell + cells.turns);
    }
}

}  // namespace

std::vector<float> water_ends(const SightCells& cells, const TracedPing& traced) {
    CoveredCells covered(cells);
    covered.add(traced.samples.items);
    covered.add(traced.outside_sector);
    std::vector<float> ends = covered.ends();
    end_at_borders(cells, ends);
    return ends;
}

}  // namespace sonarsim
