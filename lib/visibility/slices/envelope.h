#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/reach.h"
#include "visibility/slices/setup.h"

namespace sonarsim {

/// What a slice cuts out of a triangle: a segment over w along which q = 1 / X is linear. The line
/// is anchored at the farther end: where a triangle begins beside the sensor, q there is so large
/// that nothing is left of the rest.
struct Segment {
    float w_low, w_high;
    float w_anchor, q_anchor;
    float q_slope;  ///< dq/dw
    std::uint32_t trapezoid;

    float q_at(float w) const { return q_anchor + (w - w_anchor) * q_slope; }
};

/// How an end of a span moves with u, within the extent of the line that bounds it.
struct Border {
    float slope;  ///< dw/du
    float q;      ///< of the surface whose border it is
    Extent extent;
};

/// A visible part of a segment. Its ends move with u as the lines of the picture plane that bound
/// it: an edge of its own triangle or of one that hides it, or the line where two triangles cross.
struct VisibleSpan {
    float w_low, w_high;
    float q_low, q_high;
    Border low, high;
    Reach reach;         ///< of its surface
    std::uint32_t seen;  ///< index of its SeenFacet
};

struct EnvelopeScratch {
    std::vector<std::uint32_t> open;
};

/// The upper envelope of q over the segments, which are sorted by w_low: what is nearest at each w
/// of the slice.
void visible_spans(std::span<const Segment> segments, const SliceScene& scene, const Slice& slice,
                   Reaches& reaches, EnvelopeScratch& scratch, std::vector<VisibleSpan>& out);

}  // namespace sonarsim
