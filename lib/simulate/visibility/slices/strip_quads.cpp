#include "simulate/visibility/slices/strip_quads.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonarsim {

namespace {

/// Width of the frame's gaps, in u at u = 0; 1 % more, since they differ slightly.
float gap_width(const SliceFrame& frame) {
    const std::size_t middle = frame.slices.size() / 2;
    const float low = frame.slices[middle - 1].u;
    const float high = frame.slices[middle].u;
    return 1.01F * (high - low) / (1.0F + low * high);
}

}  // namespace

StripQuads::StripQuads(const FrameScan& scan, const PatchLimits& limits, Samples& samples)
    : scan_(scan),
      max_wedge_m_(limits.max_wedge_m),
      samples_(samples),
      out_(scan, limits, samples.items),
      widest_(gap_width(scan.frame())) {}

void StripQuads::add(const SliceResult& result) {
    const std::vector<float>& borders = scan_.frame().beam_u;
    if (beam_ + 1 == static_cast<int>(borders.size())) return;  // no width is left
    const MovedEnds* low = &result.low;
    while (borders[beam_ + 1] < result.high.u) {
        MovedEnds& border = at_border_[beam_ % 2];
        move_ends(result.slice, result.spans, borders[beam_ + 1], border);
        add_between(result, *low, border);
        low = &border;
        end_beam();
    }
    add_between(result, *low, result.high);
    if (borders[beam_ + 1] == result.high.u) end_beam();
}

/// Adds the strip of a slice between two verticals of the picture plane, to which its ends are
/// moved.
void StripQuads::add_between(const SliceResult& result, const MovedEnds& low,
                             const MovedEnds& high) {
    const Slice& slice = result.slice;
    new_quads_.clear();
    begin_.clear();
    end_.clear();
    for (std::size_t i = 0; i < result.spans.size(); ++i)
        add_span(slice, result.spans[i], outline_of(slice, result.spans[i], i, low, high));
    fill_holes(low.u);
    join(low.u);
    std::swap(open_, new_quads_);
    std::swap(last_uncovered_, end_);
    std::erase_if(open_, [&](const Quad& quad) {
        if (quad.high.u == high.u) return false;
        out_.add(quad);
        return true;
    });
}

/// Passes the open quadrilaterals on, since the next strip belongs to another beam.
void StripQuads::end_beam() {
    for (const Quad& quad : open_)
        out_.add(quad);
    open_.clear();
    last_uncovered_.clear();
    samples_.beam_begin[scan_.frame().first_beam + ++beam_] =
        static_cast<std::uint32_t>(samples_.items.size());
}

void StripQuads::add_span(const Slice& slice, const VisibleSpan& span, const SpanOutline& outline) {
    const FrontFacet& front = scan_.scene().facets[span.facet_index];
    Quad quad;
    quad.facet_index = span.facet_index;
    quad.widens = !scan_.frame().meridians;
    quad.u = slice.u;
    quad.w = span.q_low < span.q_high ? span.w_low : span.w_high;
    quad.q = std::min(span.q_low, span.q_high);
    quad.q_u = -front.normal.y() / front.height_m;
    quad.q_w = -front.normal.z() / front.height_m;
    quad.height_m = front.height_m;
    quad.range_m = span.facet_extent.range_m;
    const Interval& extent = span.facet_extent.u;
    const SpanOutline part = cut(outline, extent);
    const QuadSide& first = outline.first();
    const QuadSide& last = outline.last();
    if (extent.from > first.u) begin_.push_back({first, part.count > 0 ? part.first() : last});
    if (extent.to < last.u) end_.push_back({part.count > 0 ? part.last() : first, last});
    for (int k = 0; k + 1 < part.count; ++k) {
        quad.low = part.sides[k];
        quad.high = part.sides[k + 1];
        if (quad.low.low < quad.low.high || quad.high.low < quad.high.high)
            new_quads_.push_back(quad);
    }
}

/// Fills the holes on both sides of the border at u with the quadrilaterals on the other side.
void StripQuads::fill_holes(float u) {
    for (const UncoveredPart& hole : begin_) {
        for (const Quad& quad : open_)
            fill(hole, quad, quad.high, quad.low);
    }
    for (const UncoveredPart& hole : last_uncovered_) {
        for (const Quad& quad : new_quads_) {
            if (quad.low.u == u) fill(hole, quad, quad.low, quad.high);
        }
    }
}

/// Continues a quadrilateral over its side `near`, at a border of strips, into a hole.
void StripQuads::fill(const UncoveredPart& hole, const Quad& quad, const QuadSide& near,
                      const QuadSide& far) {
    const Interval& extent = scan_.facet_extent(quad.facet_index).u;
    const float from = std::max(hole.low.u, extent.from);
    const float to = std::min(hole.high.u, extent.to);
    if (!(from < to) || near.u == far.u) return;
    const auto side = [&](float u) -> QuadSide {
        const QuadSide here = between(hole.low, hole.high, u);
        const QuadSide there = between(near, far, u);
        const float low = std::min(std::max(there.low, here.low), here.high);
        return {u, low, std::max(std::min(there.high, here.high), low)};
    };
    Quad more = quad;
    more.low = side(from);
    more.high = side(to);
    if (more.low.low < more.low.high || more.high.low < more.high.high) out_.add(more);
}

/// Joins the open quadrilaterals with the new ones at u, and passes the others on.
void StripQuads::join(float u) {
    auto open = open_.begin();
    for (Quad& quad : new_quads_) {
        if (quad.low.u != u) continue;
        for (; open != open_.end() && open->high.low < quad.low.high; ++open) {
            if (go_on(*open, quad)) {
                quad.range_m = {std::min(quad.range_m.from, open->range_m.from),
                                std::max(quad.range_m.to, open->range_m.to)};
                quad.low = open->low;
                ++open;
                break;
            }
            out_.add(*open);
        }
    }
    for (; open != open_.end(); ++open)
        out_.add(*open);
}

/// True if `quad` continues an open one, and both make one patch.
bool StripQuads::go_on(const Quad& open, const Quad& quad) const {
    const float most = max_bend * (quad.low.high - quad.low.low);
    if (!(std::fabs(open.high.low - quad.low.low) < most &&
          std::fabs(open.high.high - quad.low.high) < most &&
          quad.high.u - open.low.u <= widest_ * (1.0F + quad.low.u * quad.low.u) &&
          straight(open.low, quad.low, quad.high) &&
          scan_.one_plane(open.facet_index, quad.facet_index, quad.range_m.to))) {
        return false;
    }
    Quad both = quad;
    both.low = open.low;
    const Eigen::Array4f r = both.corners().range;
    const float wedge = std::fabs(r[3] - r[0]) - std::fabs(r[2] - r[1]);
    return std::fabs(wedge) < max_wedge_m_;
}

}  // namespace sonarsim
