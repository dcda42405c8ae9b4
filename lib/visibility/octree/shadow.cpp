#include "visibility/octree/shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr int most_columns = 8192;

// Positions are floats, off by some 1e-7 of the range. Within a hundred times that of the sensor's
// z axis an azimuth is a matter of rounding.
constexpr double axis_per_range = 1e-5;

// A plane that passes the sensor at less than its own rounding is seen edge-on.
constexpr double edge_on_per_range = 1e-7;

// Azimuths are floats: of a facet a few beams wide, a part narrower than this share of it may as
// well lie in the next beam.
constexpr float least_width = 1e-4F;

// And of the rows that a facet spans, less than a float can tell of their sum.
constexpr float least_share = 1e-5F;

/// Keeps a divisor away from zero, where only the sign of the quotient matters.
float divisor(float x) {
    return std::fabs(x) > 1e-9F ? x : std::copysign(1e-9F, x);
}

/// An index in [0, count]; a facet close to the sonar reaches far beyond the view.
int cell(float x, int count) {
    return static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(count)));
}

}  // namespace

AngularCells::AngularCells(const View& view, float cell_rad) : beams_(view.beams) {
    const double beam = view.azimuth_rad / view.beams;
    columns_per_beam_ =
        std::clamp(static_cast<int>(beam / cell_rad + 0.5), 1, std::max(most_columns / beams_, 1));
    columns_ = beams_ * columns_per_beam_;
    rows_ = std::clamp(static_cast<int>(std::ceil(view.elevation_rad / cell_rad)), 4, 2048);
    beams_per_rad_ = static_cast<float>(1.0 / beam);
    turn_beams_ = static_cast<float>(2.0 * pi / beam);
    const SinCos half = sincos(0.5 * view.elevation_rad);
    rows_per_slope_ = static_cast<float>(0.5 * rows_ * half.cos / half.sin);
    const double least_rho = axis_per_range * view.range_max_m;
    least_rho2_ = static_cast<float>(least_rho * least_rho);
    least_height_ = static_cast<float>(edge_on_per_range * view.range_max_m);
    depth_.assign(static_cast<std::size_t>(columns_) * rows_, 0.0F);
}

void AngularCells::cover(const SeenFacet& seen, float beams_u, float beams_v, float rows_u,
                         float rows_v, float grow) {
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const float u = per_beam * beams_u;
    const float v = per_beam * beams_v;
    const float reach = grow * (std::fabs(u) + std::fabs(v));
    const float centre = per_beam * seen.beam - 0.5F;
    const int first = cell(std::ceil(centre - reach), columns_);
    const int last = cell(std::floor(centre + reach) + 1.0F, columns_);
    const float determinant = grow * std::fabs(u * rows_v - v * rows_u);
    const float per_u = 1.0F / divisor(u);
    const float per_v = 1.0F / divisor(v);
    const float wide_u = std::fabs(determinant * per_u);
    const float wide_v = std::fabs(determinant * per_v);
    const float nearest = seen.depth + seen.depth_range;
    const float farthest = seen.depth - seen.depth_range;
    for (int column = first; column < last; ++column) {
        // Within the parallelogram: both coordinates along its edges within [-1, 1].
        const float d = static_cast<float>(column) - centre;
        const float middle_u = d * rows_u * per_u;
        const float middle_v = d * rows_v * per_v;
        const float low = std::max(middle_u - wide_u, middle_v - wide_v) + seen.row - 0.5F;
        const float high = std::min(middle_u + wide_u, middle_v + wide_v) + seen.row - 0.5F;
        const int begin = cell(std::ceil(low), rows_);
        const int end = cell(std::floor(high) + 1.0F, rows_);
        float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float base =
            seen.depth + seen.depth_beam * d / per_beam + seen.depth_row * (0.5F - seen.row);
        for (int row = begin; row < end; ++row) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(row), farthest, nearest);
            cells[row] = std::max(cells[row], depth);
        }
    }
}

void AngularCells::close_holes() {
    std::vector<float> closed = depth_;
    const auto rows = static_cast<std::size_t>(rows_);
    for (std::size_t column = 1; column + 1 < static_cast<std::size_t>(columns_); ++column) {
        const float* const here = depth_.data() + column * rows;
        const float* const left = here - rows;
        const float* const right = here + rows;
        float* const to = closed.data() + column * rows;
        for (std::size_t r = 1; r + 1 < rows; ++r) {
            const float across = std::min(left[r], right[r]);
            const float along = std::min(here[r - 1], here[r + 1]);
            to[r] = std::max(here[r], std::max(across, along));
        }
    }
    depth_ = std::move(closed);
}

void AngularCells::mask_cone(const View& view) {
    const auto cosine = static_cast<float>(sincos(0.5 * view.azimuth_rad).cos);
    for (int column = 0; column < columns_; ++column) {
        const double azimuth = view.azimuth_rad * ((column + 0.5) / columns_ - 0.5);
        const auto x = static_cast<float>(sincos(azimuth).cos);
        float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        for (int row = 0; row < rows_; ++row) {
            const float slope =
                (static_cast<float>(row) + 0.5F - 0.5F * static_cast<float>(rows_)) /
                rows_per_slope_;
            if (x < cosine * std::sqrt(1.0F + slope * slope))
                cells[row] = std::numeric_limits<float>::infinity();
        }
    }
}

/// Whether nothing hides the facet or cuts it off: nearly always so.
bool AngularCells::is_open(const SeenFacet& seen) const {
    const float tall = seen.half_rows + std::fabs(seen.rows_u);
    if (seen.row - tall < 0.0F || seen.row + tall >= static_cast<float>(rows_)) return false;
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const int begin = static_cast<int>(seen.row - tall);
    const int end = static_cast<int>(seen.row + tall) + 1;
    const int columns_begin = cell(per_beam * (seen.beam - seen.half_beams), columns_);
    const int columns_end = cell(per_beam * (seen.beam + seen.half_beams) + 1.0F, columns_);
    const float nearest = seen.depth + seen.depth_range + seen.slack;
    const float farthest = seen.depth - seen.depth_range + seen.slack;
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float d = (static_cast<float>(column) + 0.5F) / per_beam - seen.beam;
        const float base =
            seen.depth + seen.depth_beam * d + seen.depth_row * (0.5F - seen.row) + seen.slack;
        for (int r = begin; r < end; ++r) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(r), farthest, nearest);
            if (cells[r] > depth) return false;
        }
    }
    return true;
}

AngularCells::Part AngularCells::piece(const SeenFacet& seen, int beam, bool open,
                                       SeenPiece& piece) const {
    const auto b = static_cast<float>(beam);
    const float per_half = 1.0F / seen.half_beams;
    const float from = std::max((b - seen.beam) * per_half, -1.0F);
    const float to = std::min((b + 1.0F - seen.beam) * per_half, 1.0F);
    piece.u = 0.5F * (from + to);
    piece.half_u = 0.5F * (to - from);
    if (!(piece.half_u > 0.0F)) return Part::unseen;
    const bool wide = piece.half_u > least_width;
    if (open) {
        piece.share = piece.half_u;
        piece.v = 0.0F;
        piece.half_v = 1.0F;
        return wide ? Part::seen : Part::too_small;
    }
    const float row = seen.row + piece.u * seen.rows_u;
    const float low = row - seen.half_rows;
    const float high = row + seen.half_rows;
    const int begin = cell(low, rows_);
    const int end = cell(std::floor(high) + 1.0F, rows_);
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const float left = per_beam * (seen.beam + (piece.u - piece.half_u) * seen.half_beams);
    const float right = per_beam * (seen.beam + (piece.u + piece.half_u) * seen.half_beams);
    const int columns_begin =
        std::max(static_cast<int>(std::floor(left)), beam * columns_per_beam_);
    const int columns_end =
        std::min(static_cast<int>(std::floor(right)) + 1, (beam + 1) * columns_per_beam_);
    const float nearest = seen.depth + seen.depth_range + seen.slack;
    const float farthest = seen.depth - seen.depth_range + seen.slack;
    float sum = 0.0F;
    float moment = 0.0F;
    float least = high;
    float most = low;
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float width = std::min(right, static_cast<float>(column + 1)) -
                            std::max(left, static_cast<float>(column));
        const float d = (static_cast<float>(column) + 0.5F) / per_beam - seen.beam;
        const float base =
            seen.depth + seen.depth_beam * d + seen.depth_row * (0.5F - seen.row) + seen.slack;
        for (int r = begin; r < end; ++r) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(r), farthest, nearest);
            if (cells[r] > depth) continue;
            const float bottom = std::max(low, static_cast<float>(r));
            const float top = std::min(high, static_cast<float>(r + 1));
            const float weight = width * (top - bottom);
            sum += weight;
            moment += weight * 0.5F * (bottom + top);
            least = std::min(least, bottom);
            most = std::max(most, top);
        }
    }
    if (!(sum > 0.0F)) return Part::unseen;
    const float whole = (right - left) * (high - low);
    piece.share = piece.half_u * std::min(sum / whole, 1.0F);
    if (!(wide && piece.share > least_share)) return Part::too_small;
    const float per_rows = 1.0F / seen.half_rows;
    piece.v = (moment / sum - row) * per_rows;
    // The visible rows are one run, or nearly: as long as their number, within what was met.
    piece.half_v = 0.5F * (most - least) * per_rows;
    return Part::seen;
}

}  // namespace sonarsim
