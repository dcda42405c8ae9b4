#include "simulate/visibility/strips/column_scan.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

constexpr std::uint32_t no_triangle = 0xFFFFFFFFU;

}  // namespace

ColumnScan::ColumnScan(const ClusterMesh& mesh, const std::vector<StripTriangle>& triangles,
                       const ColumnFrame& frame, const LocalPose& pose, const StripRule& rule,
                       std::vector<Sample>& out)
    : triangles_(triangles),
      frame_(frame),
      rule_(rule),
      visibility_(pieces_),
      samples_(mesh, frame, pose, rule, pieces_, out),
      hider_(triangles.size(), no_triangle),
      piece_of_(triangles.size(), 0),
      column_of_(triangles.size(), -1) {}

void ColumnScan::scan(std::span<const std::uint32_t> of_column, float left, float right) {
    if (of_column.empty()) return;
    const int column = ++column_;
    pieces_.gather(triangles_, of_column, left, right, frame_.reach_w(left, right));
    for (int i = 0; i < pieces_.count(); ++i) {
        piece_of_[pieces_.triangle(i)] = i;
        column_of_[pieces_.triangle(i)] = column;
    }
    for (int i = 0; i < pieces_.count(); ++i) {
        const std::uint32_t hider = hider_[pieces_.triangle(i)];
        int first = PieceVisibility::none;
        if (hider != no_triangle && column_of_[hider] == column) {
            const StripTriangle& t = triangles_[pieces_.triangle(i)];
            first = piece_of_[hider];
            if (visibility_.covers(first, i, t.u1, t.w1, pieces_.from(i), pieces_.to(i))) continue;
        }
        visibility_.begin(i, first);
        add_piece(i);
    }
}

void ColumnScan::add_piece(int i) {
    const StripTriangle& t = triangles_[pieces_.triangle(i)];
    const float from = pieces_.from(i);
    const float to = pieces_.to(i);
    if (!(t.u1 > from && t.u1 < to)) return add_between(i, from, to);
    const PieceBlock& p = pieces_.block_of(i);
    const int k = i % lanes;
    const float steepest = std::max(std::fabs(p.w_min[k]), std::fabs(p.w_max[k]));
    const float depth = std::max(1.0F / p.q_min[k] - 1.0F / p.q_max[k],
                                 (p.w_max[k] - p.w_min[k]) * steepest / p.q_min[k]);
    if (!(depth > rule_.small_m) && frame_.surely_sees(from, to, p.w_min[k], p.w_max[k]))
        return add_small(i, t);
    add_between(i, from, t.u1);
    add_between(i, t.u1, to);
}

/// A piece with a corner, in few bins: one strip at its middle, with the share of the piece's area
/// that is visible there.
void ColumnScan::add_small(int i, const StripTriangle& t) {
    const float from = pieces_.from(i);
    const float to = pieces_.to(i);
    const float u = 0.5F * (from + to);
    const auto length_at = [&](float at) { return pieces_.high(i, at).w - pieces_.low(i, at).w; };
    const float length = length_at(u);
    if (!(length > 0.0F)) return;
    const float at_corner = length_at(t.u1);
    const float picture = 0.5F * ((length_at(from) + at_corner) * (t.u1 - from) +
                                  (at_corner + length_at(to)) * (to - t.u1));
    if (!visibility_.find(u, whole_at(i, u))) {
        if (const int j = visibility_.hidden_by(); j != PieceVisibility::none)
            hider_[pieces_.triangle(i)] = pieces_.triangle(j);
        return;
    }
    const float half = 0.5F * picture / length;
    const PieceBlock& p = pieces_.block_of(i);
    const float nearer = t.q_middle / p.q[i % lanes];
    for (VisibleInterval part : visibility_.parts()) {
        part.low_slope = part.high_slope = t.long_slope;
        const float share = (part.high - part.low) / length;
        samples_.add({t, i, u - half, u, u + half, part,
                      t.area_per_unit * picture * share * nearer * nearer * nearer, true});
    }
}

/// The piece on the line u, within the view.
VisibleInterval ColumnScan::whole_at(int i, float u) const {
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

/// Moves an end of an interval of u at which the piece lies outside the view to where it enters.
void ColumnScan::clip_to_view(int i, float& from, float& to) const {
    const auto room = [&](float u) {
        const VisibleInterval whole = whole_at(i, u);
        return whole.high - whole.low;
    };
    const float at_from = room(from);
    const float at_to = room(to);
    if (at_from < 0.0F && at_to > 0.0F)
        from += (to - from) * at_from / (at_from - at_to);
    else if (at_to < 0.0F && at_from > 0.0F)
        to -= (to - from) * at_to / (at_to - at_from);
}

/// The part of a piece between two u, where its borders are straight.
void ColumnScan::add_between(int i, float from, float to) {
    const StripTriangle& t = triangles_[pieces_.triangle(i)];
    const PieceBlock& p = pieces_.block_of(i);
    if (!frame_.surely_sees(from, to, p.w_min[i % lanes], p.w_max[i % lanes]))
        clip_to_view(i, from, to);
    const float u = 0.5F * (from + to);
    const VisibleInterval whole = whole_at(i, u);
    if (!(whole.high > whole.low)) return;
    if (!visibility_.find(u, whole)) {
        if (const int j = visibility_.hidden_by(); j != PieceVisibility::none)
            hider_[pieces_.triangle(i)] = pieces_.triangle(j);
        return;
    }
    for (const VisibleInterval& part : visibility_.parts())
        samples_.add({t, i, from, u, to, part});
}

}  // namespace sonarsim
