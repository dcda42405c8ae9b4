#pragma once

#include <array>
#include <cstddef>

#include "simulate/visibility/slices/envelope.h"
#include "simulate/visibility/slices/moved_ends.h"
#include "simulate/visibility/slices/quad.h"

namespace sonarsim {

// Largest distance of a quadrilateral's end from the straight line, as a share of its height.
inline constexpr float max_bend = 0.02F;

/// The part of a strip that a span fills: sides between which its ends are straight, in the order
/// of u.
struct SpanOutline {
    std::array<QuadSide, 7> sides;
    int count = 0;

    void add(const QuadSide& side) { sides[count++] = side; }
    const QuadSide& first() const { return sides[0]; }
    const QuadSide& last() const { return sides[count - 1]; }
};

/// The outline of a span's strip between the verticals that its ends are moved to. An end that
/// reaches the view's border on the way has a side there; without it, the corner in which an edge
/// of the surface meets the border would be cut off. A bend at the slice itself is left out if it
/// is small.
SpanOutline outline_of(const Slice& slice, const VisibleSpan& span, std::size_t index,
                       const MovedEnds& low, const MovedEnds& high);

/// The part of an outline within an interval of u; empty if there is none.
SpanOutline cut(const SpanOutline& outline, const Interval& u);

/// The side at u on the straight lines through the ends of two sides.
QuadSide between(const QuadSide& a, const QuadSide& b, float u);

/// True if the straight lines from one side to another pass both ends of the side between them.
bool straight(const QuadSide& low, const QuadSide& middle, const QuadSide& high);

}  // namespace sonarsim
