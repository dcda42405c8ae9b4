#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/envelope.h"

namespace sonarsim {

/// An end of a visible span, moved to a vertical beside its slice.
struct MovedEnd {
    float at_slice;    ///< w
    float alone;       ///< w that it moves to by itself
    float w;           ///< that it is moved to
    float q;           ///< of the surface that it follows
    std::uint32_t by;  ///< the end that it follows
};

/// The ends of all spans of a slice at one vertical of the picture plane, two per span.
struct MovedEnds {
    float u;
    std::vector<MovedEnd> ends;
};

/// Moves the ends of a slice's spans to the vertical at u, along the lines that bound them. Where
/// two ends cross, the one of the nearer surface goes on and the other follows it.
void move_ends(const Slice& slice, std::span<const VisibleSpan> spans, float u, MovedEnds& out);

}  // namespace sonarsim
