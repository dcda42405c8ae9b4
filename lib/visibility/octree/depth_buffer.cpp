#include "visibility/octree/depth_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// Azimuths are floats: if a facet ends just beyond the border of a beam, a part narrower than this
// share of the facet may really lie in the next beam.
constexpr float least_width = 1e-4F;

// The same for rows: a smaller share of the rows that a facet spans is rounding.
constexpr float least_share = 1e-5F;

// First-order projection is valid only for facets whose half extent, as a tangent, is below this.
constexpr float widest_facet = 0.1F;

/// Keeps a divisor away from zero. Only the sign of the quotient matters there.
float divisor(float x) {
    return std::fabs(x) > 1e-9F ? x : std::copysign(1e-9F, x);
}

/// An index in [0, count]; a facet close to the sonar extends far beyond the view.
int index_in(float x, int count) {
    return static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(count)));
}

/// The depth limits of a facet in the pixels of one column, by row. Surface hides the facet if it
/// is nearer than the facet's plane at the pixel's centre by more than the slack. The plane counts
/// only up to the farthest point of the facet, but may be much nearer than the facet: at grazing
/// incidence many facets of one plane share a pixel, and the facet drawn at its centre must hide
/// none of them.
class ColumnDepths {
  public:
    ColumnDepths(const ProjectedFacet& facet, int column, float columns_per_beam)
        : farthest_(facet.depth - facet.depth_range + facet.slack), per_row_(facet.depth_row) {
        const float d = (static_cast<float>(column) + 0.5F) / columns_per_beam - facet.beam;
        first_ =
            facet.depth + facet.depth_beam * d + facet.depth_row * (0.5F - facet.row) + facet.slack;
    }

    float at(int row) const {
        return std::max(first_ + per_row_ * static_cast<float>(row), farthest_);
    }

  private:
    float farthest_, per_row_, first_;
};

}  // namespace

DepthBuffer::DepthBuffer(const ProjectionGrid& grid)
    : grid_(grid), depth_(static_cast<std::size_t>(grid.columns) * grid.rows, 0.0F) {}

void DepthBuffer::draw(const ProjectedFacet& facet) {
    const auto& [beams_u, beams_v, rows_u, rows_v] = facet.outline;
    const auto per_beam = static_cast<float>(grid_.columns_per_beam);
    const float u = per_beam * beams_u;
    const float v = per_beam * beams_v;
    const float reach = std::fabs(u) + std::fabs(v);
    const float centre = per_beam * facet.beam - 0.5F;
    const int first = index_in(std::ceil(centre - reach), grid_.columns);
    const int last = index_in(std::floor(centre + reach) + 1.0F, grid_.columns);
    const float determinant = std::fabs(u * rows_v - v * rows_u);
    const float per_u = 1.0F / divisor(u);
    const float per_v = 1.0F / divisor(v);
    const float wide_u = std::fabs(determinant * per_u);
    const float wide_v = std::fabs(determinant * per_v);
    const float nearest = facet.depth + facet.depth_range;
    const float farthest = facet.depth - facet.depth_range;
    for (int column = first; column < last; ++column) {
        // Inside the parallelogram both coordinates along its edges are within [-1, 1].
        const float d = static_cast<float>(column) - centre;
        const float middle_u = d * rows_u * per_u;
        const float middle_v = d * rows_v * per_v;
        const float low = std::max(middle_u - wide_u, middle_v - wide_v) + facet.row - 0.5F;
        const float high = std::min(middle_u + wide_u, middle_v + wide_v) + facet.row - 0.5F;
        const int begin = index_in(std::ceil(low), grid_.rows);
        const int end = index_in(std::floor(high) + 1.0F, grid_.rows);
        float* const pixels = pixels_of(column);
        const float base =
            facet.depth + facet.depth_beam * d / per_beam + facet.depth_row * (0.5F - facet.row);
        for (int row = begin; row < end; ++row) {
            const float depth =
                std::clamp(base + facet.depth_row * static_cast<float>(row), farthest, nearest);
            pixels[row] = std::max(pixels[row], depth);
        }
    }
}

void DepthBuffer::mask_cone(double opening_rad) {
    // Computed in double from the sine: in float the cosine of half an opening of 0.1 degrees is 1.
    const double sine = sincos(0.5 * opening_rad).sin;
    for (int column = 0; column < grid_.columns; ++column) {
        const double azimuth = opening_rad * ((column + 0.5) / grid_.columns - 0.5);
        const double y = sincos(azimuth).sin;
        float* const pixels = pixels_of(column);
        for (int row = 0; row < grid_.rows; ++row) {
            const double slope = (row + 0.5 - 0.5 * grid_.rows) / grid_.rows_per_slope;
            if (y * y + slope * slope > sine * sine * (1.0 + slope * slope))
                pixels[row] = std::numeric_limits<float>::infinity();
        }
    }
}

bool DepthBuffer::is_fully_visible(const ProjectedFacet& facet) const {
    const float tall = facet.half_rows + std::fabs(facet.rows_u);
    if (facet.row - tall < 0.0F || facet.row + tall >= static_cast<float>(grid_.rows)) return false;
    const auto per_beam = static_cast<float>(grid_.columns_per_beam);
    const int begin = static_cast<int>(facet.row - tall);
    const int end = static_cast<int>(facet.row + tall) + 1;
    const int columns_begin = index_in(per_beam * (facet.beam - facet.half_beams), grid_.columns);
    const int columns_end =
        index_in(per_beam * (facet.beam + facet.half_beams) + 1.0F, grid_.columns);
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const pixels = pixels_of(column);
        const ColumnDepths depths(facet, column, per_beam);
        for (int r = begin; r < end; ++r) {
            if (pixels[r] > depths.at(r)) return false;
        }
    }
    return true;
}

DepthBuffer::VisibleRows DepthBuffer::visible_rows(const ProjectedFacet& facet, int beam, float low,
                                                   float high) const {
    const auto b = static_cast<float>(beam);
    const auto per_beam = static_cast<float>(grid_.columns_per_beam);
    const float left = per_beam * std::max(b, facet.beam - facet.half_beams);
    const float right = per_beam * std::min(b + 1.0F, facet.beam + facet.half_beams);
    const int columns_begin =
        std::max(static_cast<int>(std::floor(left)), beam * grid_.columns_per_beam);
    const int columns_end =
        std::min(static_cast<int>(std::floor(right)) + 1, (beam + 1) * grid_.columns_per_beam);
    const int begin = index_in(low, grid_.rows);
    const int end = index_in(std::floor(high) + 1.0F, grid_.rows);
    VisibleRows seen{.area = 0.0F, .moment = 0.0F, .least = high, .most = low};
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const pixels = pixels_of(column);
        const float width = std::min(right, static_cast<float>(column + 1)) -
                            std::max(left, static_cast<float>(column));
        const ColumnDepths depths(facet, column, per_beam);
        for (int r = begin; r < end; ++r) {
            if (pixels[r] > depths.at(r)) continue;
            const float bottom = std::max(low, static_cast<float>(r));
            const float top = std::min(high, static_cast<float>(r + 1));
            const float weight = width * (top - bottom);
            seen.area += weight;
            seen.moment += weight * 0.5F * (bottom + top);
            seen.least = std::min(seen.least, bottom);
            seen.most = std::max(seen.most, top);
        }
    }
    seen.share = seen.area / ((right - left) * (high - low));
    return seen;
}

DepthBuffer::Visibility DepthBuffer::visible_part(const ProjectedFacet& facet, int beam, bool clear,
                                                  VisiblePart& part) const {
    const auto b = static_cast<float>(beam);
    const float per_half = 1.0F / facet.half_beams;
    const float from = std::max((b - facet.beam) * per_half, -1.0F);
    const float to = std::min((b + 1.0F - facet.beam) * per_half, 1.0F);
    part.u = 0.5F * (from + to);
    part.half_u = 0.5F * (to - from);
    if (!(part.half_u > 0.0F)) return Visibility::hidden;
    // If a beam or a view is much narrower than the facet, even a small visible part is no rounding
    // error, since both borders lie well inside the facet.
    const bool well_projected = facet.half_beams < widest_facet * grid_.beams_per_rad &&
                                facet.half_rows < widest_facet * grid_.rows_per_slope;
    const bool fills_beam = well_projected && from > -1.0F && to < 1.0F;
    const bool wide = fills_beam || part.half_u > least_width;
    if (clear) {
        part.share = part.half_u;
        part.v = 0.0F;
        part.half_v = 1.0F;
        return wide ? Visibility::visible : Visibility::too_small;
    }
    const float row = facet.row + part.u * facet.rows_u;
    const float low = row - facet.half_rows;
    const float high = row + facet.half_rows;
    const VisibleRows seen = visible_rows(facet, beam, low, high);
    if (!(seen.area > 0.0F)) return Visibility::hidden;
    part.share = part.half_u * std::min(seen.share, 1.0F);
    const bool fills_rows = well_projected && seen.least > low && seen.most < high;
    if (!(wide && (fills_beam || fills_rows || part.share > least_share)))
        return Visibility::too_small;
    const float per_rows = 1.0F / facet.half_rows;
    part.v = (seen.moment / seen.area - row) * per_rows;
    // The visible rows are contiguous, or nearly so: half_v follows from the first and the last
    // one.
    part.half_v = 0.5F * (seen.most - seen.least) * per_rows;
    return Visibility::visible;
}

}  // namespace sonarsim
