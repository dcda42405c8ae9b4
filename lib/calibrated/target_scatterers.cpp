#include "calibrated/target_scatterers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibrated/lanes.h"
#include "core/elementary.h"

namespace sonarsim {

namespace {

/// Sums of echoes, by power.
struct Joint {
    float power = 0.0F;
    float range = 0.0F;
    Eigen::Vector3f place = Eigen::Vector3f::Zero();

    void add(float more, float range_m, const Eigen::Vector3f& at) {
        power += more;
        range += more * range_m;
        place += more * at;
    }
    void add(const Joint& more) {
        power += more.power;
        range += more.range;
        place += more.place;
    }
    float range_m() const { return range / power; }
    Eigen::Vector3f middle() const { return place / power; }
};

/// The number of the cell at an offset from the middle one; size 0: all is one cell.
std::int32_t cell_at(float offset, float size) {
    constexpr float most = 1e5F;
    if (!(size > 0.0F)) return 0;
    return static_cast<std::int32_t>(std::clamp(std::round(offset / size), -most, most));
}

/// The numbers of a cell in one word, 21 bits each.
std::uint64_t cell_word(std::int32_t i, std::int32_t j, std::int32_t l) {
    const auto bits = [](std::int32_t k) { return static_cast<std::uint64_t>(k) & 0x1FFFFFU; };
    return bits(i) << 42U | bits(j) << 21U | bits(l);
}

/// Echoes of a surface in one cell.
struct CellEchoes {
    std::uint64_t cell;
    Joint all;
    float highlight;  ///< power of the highlight
};

/// A block of scatterers, handed on when it is full.
class ScattererBlock {
  public:
    using Use = std::function<void(const PatchBlock&, PointEchoes&, Amplitudes&)>;

    ScattererBlock(const TargetCells& cells, const SonarEquation& equation, const Use& use)
        : cells_(cells), equation_(equation), use_(use) {}

    /// `turns`: the scatterer's own phase.
    void add(const Joint& joint, float strength, float turns) {
        const float range = joint.range_m();
        const double way = cells_.turns_per_m * static_cast<double>(range);
        const SinCosFloat phase = sincos_turns(turns + static_cast<float>(way - std::floor(way)));
        const float amplitude = std::sqrt(joint.power * strength);
        const int at = points_.count++;
        put(at, joint.middle(), range, joint.power);
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
    for (int k = 0; k < points.count; ++k) {
        if (!(echoes.power[k] > 0.0F)) continue;
        const TargetFacet& facet = facets[pieces.facet[k]];
        const float range = echoes.range_m[k];
        const float height = points.height_m[k];
        const float steepest = highlight_slopes * slopes[facet.material] * height;
        echoes_.push_back({.instance = facet.instance,
                           .region = facet.region,
                           .place = {points.x[k], points.y[k], points.z[k]},
                           .range_m = range,
                           .power = echoes.power[k],
                           .highlight = range * range - height * height < steepest * steepest});
    }
}

TargetScatterers::Surface TargetScatterers::surface_from(std::size_t first) const {
    Joint highlight, all;
    std::size_t end = first;
    for (; end < echoes_.size() && echoes_[end].instance == echoes_[first].instance &&
           echoes_[end].region == echoes_[first].region;
         ++end) {
        const Echo& echo = echoes_[end];
        all.add(echo.power, echo.range_m, echo.place);
        if (echo.highlight) highlight.add(echo.power, echo.range_m, echo.place);
    }
    const Joint& about = highlight.power > 0.0F ? highlight : all;
    return {first, end, about.middle(), about.range_m(), highlight.power};
}

void TargetScatterers::finish(const TargetCells& cells, const SonarEquation& equation,
                              PhiloxKey key, const ScattererUse& use) {
    ScattererBlock block(cells, equation, use);
    std::vector<CellEchoes> parts;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::size_t first = 0; first < echoes_.size();) {
        const Surface surface = surface_from(first);
        parts.clear();
        for (std::size_t k = first; k < surface.end; ++k) {
            const Echo& echo = echoes_[k];
            const Eigen::Vector3f off = (echo.place - surface.middle) / surface.range_m;
            const std::uint64_t cell =
                cell_word(cell_at(echo.range_m - surface.range_m, cells.depth_m),
                          cell_at(off.y(), cells.sine_y), cell_at(off.z(), cells.sine_z));
            // Pieces of one cell often come one after the other.
            if (parts.empty() || parts.back().cell != cell) parts.push_back({cell, {}, 0.0F});
            parts.back().all.add(echo.power, echo.range_m, echo.place);
            if (echo.highlight) parts.back().highlight += echo.power;
        }
        order.clear();
        for (std::uint32_t k = 0; k < parts.size(); ++k)
            order.emplace_back(parts[k].cell, k);
        std::ranges::sort(order);
        for (std::size_t k = 0; k < order.size();) {
            const std::uint64_t cell = order[k].first;
            Joint joint;
            float highlight = 0.0F;
            for (; k < order.size() && order[k].first == cell; ++k) {
                const CellEchoes& part = parts[order[k].second];
                joint.add(part.all);
                highlight += part.highlight;
            }
            const PhiloxBlock words =
                philox({echoes_[first].instance, echoes_[first].region,
                        static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell >> 32U)},
                       key);
            // 1 if the cell holds all of the highlight and nothing else.
            const float steady =
                highlight > 0.0F ? highlight / surface.highlight_power * (highlight / joint.power)
                                 : 0.0F;
            block.add(joint, steady - (1.0F - steady) * natural_log(unit_float(words.x0)),
                      unit_float(words.x1));
        }
        first = surface.end;
    }
    block.flush();
    echoes_.clear();
}

}  // namespace sonarsim
