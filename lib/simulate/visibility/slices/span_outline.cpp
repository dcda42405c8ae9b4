#include "simulate/visibility/slices/span_outline.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// An end that reaches the view's border within this share of the way from its slice, or from the
// other side, has no side there: it would bound a sliver.
constexpr float min_stop = 0.01F;

/// The border of a span's quadrilateral on one side: the side itself, or before it the point where
/// the two ends meet, or where one of them meets the end that both follow.
QuadSide quad_side(const Slice& slice, const MovedEnds& side, std::size_t span) {
    const MovedEnd& low = side.ends[2 * span];
    const MovedEnd& high = side.ends[2 * span + 1];
    if (low.w < high.w || low.follows != high.follows) return {side.u, low.w, high.w};
    const MovedEnd& leader = side.ends[low.follows];
    const bool from_below = low.follows <= 2 * span;
    const float before =
        from_below ? high.at_slice - leader.at_slice : leader.at_slice - low.at_slice;
    const float after = from_below ? leader.w - high.w_by_itself : low.w_by_itself - leader.w;
    const float share = after > 0.0F ? before / (before + after) : 1.0F;
    const float w = leader.at_slice + share * (leader.w - leader.at_slice);
    return {slice.u + share * (side.u - slice.u), w, w};
}

/// w of an end at a share of the way from its slice to where it is moved.
float w_on_way(const MovedEnd& end, float share) {
    if (share < end.stop) return end.at_slice + share / end.stop * (end.w_stop - end.at_slice);
    return end.w_stop + (share - end.stop) / (1.0F - end.stop) * (end.w - end.w_stop);
}

/// Adds the sides at which the ends of a span reach the view's border on their way to `moved`, if
/// they lie within the strip.
void add_stops(const Slice& slice, const MovedEnds& moved, std::size_t span, Interval strip,
               SpanOutline& outline) {
    const MovedEnd& low = moved.ends[2 * span];
    const MovedEnd& high = moved.ends[2 * span + 1];
    const auto [nearer, farther] = std::minmax({low.stop, high.stop});
    const bool backwards = moved.u < slice.u;
    for (const float share : {backwards ? farther : nearer, backwards ? nearer : farther}) {
        const float u = slice.u + share * (moved.u - slice.u);
        if (!(share > min_stop && share < 1.0F - min_stop)) continue;
        if (!(strip.from < u && u < strip.to)) continue;
        if (outline.count > 0 && outline.last().u == u) continue;
        outline.add({u, w_on_way(low, share), w_on_way(high, share)});
    }
}

}  // namespace

QuadSide between(const QuadSide& a, const QuadSide& b, float u) {
    const float share = (u - a.u) / (b.u - a.u);
    return {u, a.low + share * (b.low - a.low), a.high + share * (b.high - a.high)};
}

bool straight(const QuadSide& low, const QuadSide& middle, const QuadSide& high) {
    const QuadSide line = between(low, high, middle.u);
    const float most = max_bend * (middle.high - middle.low);
    return std::fabs(line.low - middle.low) <= most && std::fabs(line.high - middle.high) <= most;
}

SpanOutline outline_of(const Slice& slice, const VisibleSpan& span, std::size_t index,
                       const MovedEnds& low, const MovedEnds& high) {
    const QuadSide first = quad_side(slice, low, index);
    const QuadSide last = quad_side(slice, high, index);
    const Interval strip{first.u, last.u};
    SpanOutline outline;
    outline.add(first);
    if (first.u == low.u) add_stops(slice, low, index, strip, outline);
    if (first.u < slice.u && slice.u < last.u) {
        const QuadSide on_slice{slice.u, span.w_low, span.w_high};
        SpanOutline beyond;
        if (last.u == high.u) add_stops(slice, high, index, strip, beyond);
        beyond.add(last);
        if (!straight(outline.last(), on_slice, beyond.first())) outline.add(on_slice);
        for (int k = 0; k < beyond.count; ++k)
            outline.add(beyond.sides[k]);
        return outline;
    }
    if (last.u == high.u) add_stops(slice, high, index, strip, outline);
    outline.add(last);
    return outline;
}

SpanOutline cut(const SpanOutline& outline, const Interval& u) {
    SpanOutline part;
    for (int k = 0; k + 1 < outline.count; ++k) {
        const QuadSide& a = outline.sides[k];
        const QuadSide& b = outline.sides[k + 1];
        if (!(a.u < b.u) || b.u <= u.from || a.u >= u.to) continue;
        if (part.count == 0) part.add(a.u < u.from ? between(a, b, u.from) : a);
        part.add(b.u > u.to ? between(a, b, u.to) : b);
    }
    return part;
}

}  // namespace sonarsim
