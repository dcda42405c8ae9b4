#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/visibility/slices/facet_extent.h"
#include "simulate/visibility/slices/setup.h"

namespace sonarsim {

/// The intersection of a slice with a triangle: a segment over w with linear q = 1 / X. The line is
/// anchored at the farther end: if a triangle begins next to the sensor, q there is so large that
/// float precision loses the rest.
struct Segment {
    float w_low, w_high;
    float w_anchor, q_anchor;
    float q_slope;  ///< dq/dw
    std::uint32_t trapezoid;

    float q_at(float w) const { return q_anchor + (w - w_anchor) * q_slope; }
};

/// The motion of a span's end with u, within the extent of the line that bounds it.
struct Border {
    float slope;  ///< dw/du
    float q;      ///< q of the surface whose border it is
    Interval extent;
};

/// A visible part of a segment. Its ends move with u along the lines of the picture plane that
/// bound it: an edge of its own triangle or of an occluder, or the line in which two triangles
/// cross.
struct VisibleSpan {
    float w_low, w_high;
    float q_low, q_high;
    Border low, high;
    FacetExtent facet_extent;   ///< extent of its facet
    std::uint32_t facet_index;  ///< index of its FrontFacet
};

/// The upper envelope of q over the segments, which are sorted by w_low: the nearest surface at
/// each w of the slice. The memory of `open` is reused.
void visible_spans(std::span<const Segment> segments, const SliceScene& scene, const Slice& slice,
                   FacetExtents& facet_extents, std::vector<std::uint32_t>& open,
                   std::vector<VisibleSpan>& out);

}  // namespace sonarsim
