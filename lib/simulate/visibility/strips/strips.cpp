#include "simulate/visibility/strips/strips.h"

#include <array>
#include <limits>

#include "simulate/visibility/strips/strip_samples.h"
#include "simulate/visibility/strips/strip_triangles.h"

namespace sonarsim {

namespace {

constexpr double usual_goal = 0.03;

// Thin things need more columns, in proportion, up to this many times as many.
constexpr float by_thinness = 1.3F;
constexpr float max_by_thinness = 4.0F;

// Views of energies that are thinner than this have at least two parts; fitted to a wreck.
constexpr float thin_view = 0.28F;

// Columns of a side where energies add: the beam receives most from its middle.
constexpr float side_columns = 13.0F;

// An energy is weighed by the beam pattern at the middle of its sample. A sample of a fan or a cone
// spans at most this share of the view along its column, one of a side at most this angle.
constexpr double samples_along = 32.0;
constexpr double side_along_rad = 0.0125;

// Wedges of energies are shorter than the pieces of labels. 16 bins leave holes in shadows.
constexpr float wedge_of_energies = 7.0F;

// Steps of false position towards the place where a line crosses the border of the view.
constexpr int crossing_steps = 3;

/// Finds the visible strips of a frame's columns.
class ColumnScan {
  public:
    /// All arguments must outlive it.
    ColumnScan(const ClustersInView& clusters, const std::vector<StripTriangle>& triangles,
               const ColumnFrame& frame, const StripRule& rule, std::vector<Sample>& out)
        : triangles_(triangles),
          frame_(frame),
          visibility_(pieces_),
          samples_(clusters, frame, rule, pieces_, out) {}

    /// Adds the samples of a column between two u, from its triangles.
    void scan(std::span<const std::uint32_t> column_triangles, float left, float right) {
        if (column_triangles.empty()) return;
        pieces_.gather(triangles_, column_triangles, left, right, frame_.reach_w(left, right));
        for (int i = 0; i < pieces_.count(); ++i) {
            visibility_.begin(i);
            add_piece(i);
        }
    }

  private:
    void add_piece(int i) {
        const StripTriangle& t = triangles_[pieces_.triangle(i)];
        const PieceBlock& p = pieces_.block_of(i);
        const int k = i % lanes;
        const float from = p.from[k];
        const float to = p.to[k];
        const bool inside = frame_.surely_sees(from, to, p.w_min[k], p.w_max[k]);
        const auto add = [&](float low, float high) {
            if (inside)
                add_between(i, low, high);
            else
                add_at_border(i, low, high);
        };
        if (!(t.u1 > from && t.u1 < to)) return add(from, to);
        add(from, t.u1);
        add(t.u1, to);
    }

    /// The piece on the line u, within the view.
    VisibleInterval whole_at(int i, float u) const {
        const PieceEnd low = pieces_.low(i, u);
        const PieceEnd high = pieces_.high(i, u);
        VisibleInterval out{low.w, high.w, low.slope, high.slope};
        if (frame_.surely_sees(u, u, out.low, out.high)) return out;
        const ColumnLimits view = frame_.limits_at(u);
        if (out.low < view.low) {
            out.low = view.low;
            out.low_slope = view.low_slope;
        }
        if (out.high > view.high) {
            out.high = view.high;
            out.high_slope = view.high_slope;
        }
        return out;
    }

    /// A piece at the border of the view: cuts it there, and where a line crosses the border.
    void add_at_border(int i, float from, float to) {
        struct Room {
            float low, high, all;
        };
        const auto room = [&](float u) -> Room {
            const float low = pieces_.low(i, u).w;
            const float high = pieces_.high(i, u).w;
            const ColumnLimits view = frame_.limits_at(u);
            return {low - view.low, view.high - high,
                    std::min(high, view.high) - std::max(low, view.low)};
        };
        const auto crossing = [&](float Room::*of) {
            float a = from;
            float b = to;
            float at_a = room(a).*of;
            float at_b = room(b).*of;
            float u = a;
            for (int step = 0; step < crossing_steps; ++step) {
                u = a + (b - a) * at_a / (at_a - at_b);
                const float at_u = room(u).*of;
                if (at_u == 0.0F) break;
                ((at_u < 0.0F) == (at_a < 0.0F) ? a : b) = u;
                ((at_u < 0.0F) == (at_a < 0.0F) ? at_a : at_b) = at_u;
            }
            return std::clamp(u, from, to);
        };
        const float all_from = room(from).all;
        const float all_to = room(to).all;
        if (all_from < 0.0F && all_to > 0.0F)
            from = crossing(&Room::all);
        else if (all_to < 0.0F && all_from > 0.0F)
            to = crossing(&Room::all);
        const Room at_from = room(from);
        const Room at_to = room(to);
        std::array<float, 4> u{from, to, to, to};
        if (at_from.low * at_to.low < 0.0F) u[1] = crossing(&Room::low);
        if (at_from.high * at_to.high < 0.0F) u[2] = crossing(&Room::high);
        std::ranges::sort(u);
        for (int k = 0; k < 3; ++k) {
            if (u[k + 1] > u[k]) add_between(i, u[k], u[k + 1]);
        }
    }

    /// The part of a piece between two u, where its borders are straight.
    void add_between(int i, float from, float to) {
        const StripTriangle& t = triangles_[pieces_.triangle(i)];
        const float u = 0.5F * (from + to);
        const VisibleInterval whole = whole_at(i, u);
        if (!(whole.high > whole.low)) return;
        if (!visibility_.find(u, whole)) return;
        for (const VisibleInterval& part : visibility_.parts())
            samples_.add({t, i, from, u, to, part});
    }

    const std::vector<StripTriangle>& triangles_;
    const ColumnFrame& frame_;
    ColumnPieces pieces_;
    PieceVisibility visibility_;
    StripSamples samples_;
};

StripRule strip_rule(const View& view) {
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto finer =
        static_cast<float>(std::clamp(view.relative_l1, finest_goal, usual_goal) / usual_goal);
    StripRule rule{};
    rule.columns = 1.0F / finer;
    if (view.energies_add && view.shape == ViewShape::port_starboard) rule.columns *= side_columns;
    rule.energies_add = view.energies_add;
    rule.bin_m = bin_m;
    rule.range_max_m = static_cast<float>(view.range_max_m);
    rule.sag_m = 0.09F * finer * bin_m;
    rule.wedge_m = finer * bin_m;
    rule.taper = 0.35F;
    rule.along_rad = std::numeric_limits<float>::max();
    if (view.energies_add) {
        // Energies follow the trapezoids of samples; a mean of a bin takes parallelograms.
        rule.wedge_m = wedge_of_energies * std::max(finer, 0.5F) * bin_m;
        rule.taper = 1.0F;  // any
        rule.along_rad = static_cast<float>(view.shape == ViewShape::port_starboard
                                                ? side_along_rad
                                                : view.elevation_rad / samples_along);
    }
    return rule;
}

/// Parts of each least column of a frame with such triangles (StripTriangles::thinness).
int column_parts(const StripRule& rule, float thinness) {
    constexpr float rounding = 1e-3F;
    const float least = rule.energies_add && thinness > thin_view ? 2.0F : 1.0F;
    const float parts = rule.columns * std::min(1.0F + by_thinness * thinness, max_by_thinness);
    return static_cast<int>(std::max(parts, least) + rounding);
}

/// Adds the samples of a frame's beams.
void scan(const ColumnFrame& frame, const ClustersInView& clusters, const StripTriangles& triangles,
          const StripRule& rule, Samples& samples) {
    const int parts = column_parts(rule, triangles.thinness);
    const std::vector<float> u = column_borders(frame, parts);
    const Groups groups = triangles_by_column(triangles.items, u);
    ColumnScan columns(clusters, triangles.items, frame, rule, samples.items);
    for (std::size_t k = 0; k + 1 < u.size(); ++k) {
        columns.scan(
            std::span(groups.items).subspan(groups.begin[k], groups.begin[k + 1] - groups.begin[k]),
            u[k], u[k + 1]);
        samples.beam_begin[frame.beams[k / parts] + 1] =
            static_cast<std::uint32_t>(samples.items.size());
    }
}

}  // namespace

Samples strips_surface(const ClustersInView& clusters, const View& view, std::size_t expected) {
    const StripRule rule = strip_rule(view);
    Samples samples;
    samples.beam_begin.assign(view.beams + 1, 0);
    samples.items.reserve(expected + expected / 8);
    for (const ColumnFrame& frame : strip_frames(view)) {
        const StripTriangles triangles = strip_triangles(clusters, frame, rule.range_max_m);
        scan(frame, clusters, triangles, rule, samples);
        samples.dropped += triangles.dropped;
    }
    return samples;
}

}  // namespace sonarsim
