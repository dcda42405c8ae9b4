#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/visibility/slices/envelope.h"

namespace sonarsim {

/// An end of a visible span, moved to a vertical next to its slice.
struct MovedEnd {
    float at_slice;         ///< w
    float w_by_itself;      ///< w if it moves by itself
    float w;                ///< w that it is moved to
    float q;                ///< q of the surface that it follows
    std::uint32_t follows;  ///< index of the end that it follows
    /// Share of the way at which it reaches the view's border, on which it then stays, and w there;
    /// 1: it does not reach the border.
    float stop;
    float w_stop;
};

/// The ends of all spans of a slice at one vertical of the picture plane, two per span.
struct MovedEnds {
    float u;
    std::vector<MovedEnd> ends;
};

/// Moves the ends of a slice's spans to the vertical at u, along the lines that bound them. If two
/// ends cross, the one of the nearer surface continues and the other follows it.
void move_ends(const Slice& slice, std::span<const VisibleSpan> spans, float u, MovedEnds& out);

}  // namespace sonarsim
