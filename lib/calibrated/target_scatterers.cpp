#include "calibrated/target_scatterers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/lanes.h"

namespace sonarsim {

namespace {

using Terms = Eigen::Array<float, 8, 1>;

/// Indices into Terms.
enum Term : int { power_term, range_term, x_term, y_term, z_term, highlight_term };

/// The number of the cell at an offset from the middle one, 21 bits.
std::uint64_t cell_at(float offset, float size) {
    constexpr float most = 1e5F;
    // Rounds halves away from 0. std::round() would be a call for each number.
    const float exact = offset / size;
    const float towards_0 = std::trunc(exact);
    const bool further = std::fabs(exact - towards_0) >= 0.5F;
    const float number = towards_0 + (further ? std::copysign(1.0F, exact) : 0.0F);
    const auto whole = static_cast<std::int32_t>(std::min(std::max(number, -most), most));
    return static_cast<std::uint64_t>(whole) & 0x1FFFFFU;
}

struct Cell {
    std::uint64_t number;
    Terms sums;
};

/// Sums the echoes of a surface by cell.
class CellSums {
  public:
    /// The cells in the order of their numbers. `numbers`: the cell of each echo.
    std::span<const Cell> find(std::span<const std::uint64_t> numbers,
                               std::span<const Terms> terms) {
        cells_.clear();
        slots_.assign(std::bit_ceil(2 * numbers.size()), no_cell);
        for (std::size_t k = 0; k < numbers.size();) {
            // Pieces of one cell often come one after the other.
            const std::uint64_t number = numbers[k];
            Terms sums = Terms::Zero();
            for (; k < numbers.size() && numbers[k] == number; ++k)
                sums += terms[k];
            cell_of(number).sums += sums;
        }
        std::ranges::sort(cells_, {}, &Cell::number);
        return cells_;
    }

  private:
    static constexpr std::uint32_t no_cell = 0xFFFFFFFFU;

    Cell& cell_of(std::uint64_t number) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t slot = (number * 0x9E3779B97F4A7C15U >> 32U) & mask;
        while (slots_[slot] != no_cell && cells_[slots_[slot]].number != number)
            slot = (slot + 1) & mask;
        if (slots_[slot] == no_cell) {
            slots_[slot] = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back({number, Terms::Zero()});
        }
        return cells_[slots_[slot]];
    }

    std::vector<Cell> cells_;
    std::vector<std::uint32_t> slots_;  ///< places in cells_, by a hash of the number
};

/// A block of scatterers, handed on when it is full.
class ScattererBlock {
  public:
    using Use = std::function<void(const PatchBlock&, PointEchoes&, Amplitudes&)>;

    ScattererBlock(const TargetCells& cells, const SonarEquation& equation, const Use& use)
        : cells_(cells), equation_(equation), use_(use) {}

    /// `turns`: the scatterer's own phase.
    void add(const Terms& sums, float strength, float turns) {
        const float power = sums[power_term];
        const float range = sums[range_term] / power;
        const double way = cells_.turns_per_m * static_cast<double>(range);
        const SinCosFloat phase = sincos_turns(turns + static_cast<float>(way - std::floor(way)));
        const float amplitude = std::sqrt(power * strength);
        const int at = points_.count++;
        const Eigen::Vector3f place = sums.segment<3>(x_term) / power;
        put(at, place, range, power);
        echoes_.row[at] = (range - equation_.range_min_m) / equation_.bin_m - 0.5F;
        amplitudes_.re[at] = amplitude * phase.cos;
        amplitudes_.im[at] = amplitude * phase.sin;
        if (points_.count == PatchBlock::most) flush();
    }

    void flush() {
        if (points_.count == 0) return;
        echoes_.count = (points_.count + lanes - 1) / lanes * lanes;
        for (int k = points_.count; k < echoes_.count; ++k) {
            put(k, Eigen::Vector3f::UnitX(), 1.0F, 0.0F);
            echoes_.row[k] = amplitudes_.re[k] = amplitudes_.im[k] = 0.0F;
        }
        use_(points_, echoes_, amplitudes_);
        points_.count = 0;
    }

  private:
    void put(int at, const Eigen::Vector3f& place, float range_m, float power) {
        points_.x[at] = place.x();
        points_.y[at] = place.y();
        points_.z[at] = place.z();
        echoes_.range_m[at] = range_m;
        echoes_.power[at] = power;
    }

    const TargetCells& cells_;
    const SonarEquation& equation_;
    const Use& use_;
    PatchBlock points_;
    PointEchoes echoes_{};
    Amplitudes amplitudes_{};
};

}  // namespace

void TargetScatterers::add(const TargetPieces& pieces, const PointEchoes& echoes,
                           std::span<const TargetFacet> facets, std::span<const float> slopes) {
    const PatchBlock& points = pieces.points;
    std::size_t end = terms_.size();
    const auto resize = [&](std::size_t count) {
        terms_.resize(count);
        range_m_.resize(count);
        y_.resize(count);
        z_.resize(count);
    };
    resize(end + points.count);
    for (int k = 0; k < points.count; ++k) {
        const float power = echoes.power[k];
        if (!(power > 0.0F)) continue;
        const TargetFacet& facet = facets[pieces.facet[k]];
        const float range = echoes.range_m[k];
        const float height = points.height_m[k];
        const float steepest = highlight_slopes * slopes[facet.material] * height;
        const bool is_highlight = range * range - height * height < steepest * steepest;
        const bool goes_on = !surfaces_.empty() && surfaces_.back().instance == facet.instance &&
                             surfaces_.back().region == facet.region;
        if (!goes_on) surfaces_.push_back({facet.instance, facet.region, end});
        terms_[end] = power * Terms(1.0F, range, points.x[k], points.y[k], points.z[k],
                                    is_highlight ? 1.0F : 0.0F, 0.0F, 0.0F);
        range_m_[end] = range;
        y_[end] = points.y[k];
        z_[end] = points.z[k];
        ++end;
    }
    resize(end);
}

TargetScatterers::Middle TargetScatterers::middle_of(std::size_t first, std::size_t end) const {
    Terms highlight = Terms::Zero();
    Terms all = Terms::Zero();
    for (std::size_t k = first; k < end; ++k) {
        all += terms_[k];
        if (terms_[k][highlight_term] > 0.0F) highlight += terms_[k];
    }
    const Terms& about = highlight[power_term] > 0.0F ? highlight : all;
    const Terms middle = about / about[power_term];
    return {middle[range_term], middle[y_term], middle[z_term], highlight[power_term]};
}

void TargetScatterers::find_cells(std::size_t first, std::size_t end, const Middle& middle,
                                  const TargetCells& cells) {
    const auto or_any = [](float size) {
        return size > 0.0F ? size : std::numeric_limits<float>::infinity();
    };
    const float depth = or_any(cells.depth_m);
    const float sine_y = or_any(cells.sine_y);
    const float sine_z = or_any(cells.sine_z);
    for (std::size_t k = first; k < end; ++k) {
        const std::uint64_t i = cell_at(range_m_[k] - middle.range_m, depth);
        const std::uint64_t j = cell_at((y_[k] - middle.y) / middle.range_m, sine_y);
        const std::uint64_t l = cell_at((z_[k] - middle.z) / middle.range_m, sine_z);
        cell_[k] = i << 42U | j << 21U | l;
    }
}

void TargetScatterers::finish(const TargetCells& cells, const SonarEquation& equation,
                              PhiloxKey key, const ScattererUse& use) {
    ScattererBlock block(cells, equation, use);
    CellSums sums_by_cell;
    cell_.resize(terms_.size());
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        const auto [instance, region, first] = surfaces_[s];
        const std::size_t end = s + 1 < surfaces_.size() ? surfaces_[s + 1].first : terms_.size();
        const Middle middle = middle_of(first, end);
        find_cells(first, end, middle, cells);
        for (const Cell& cell : sums_by_cell.find(std::span(cell_).subspan(first, end - first),
                                                  std::span(terms_).subspan(first, end - first))) {
            const PhiloxBlock words =
                philox({instance, region, static_cast<std::uint32_t>(cell.number),
                        static_cast<std::uint32_t>(cell.number >> 32U)},
                       key);
            const float highlight = cell.sums[highlight_term];
            // 1 if the cell holds exactly the highlight.
            const float steady = highlight > 0.0F ? highlight / middle.highlight_power *
                                                        (highlight / cell.sums[power_term])
                                                  : 0.0F;
            block.add(cell.sums, steady - (1.0F - steady) * natural_log(unit_float(words.x0)),
                      unit_float(words.x1));
        }
    }
    block.flush();
}

}  // namespace sonarsim
