#pragma once

#include <vector>

#include "simulate/visibility/slices/frame_scan.h"
#include "simulate/visibility/slices/moved_ends.h"
#include "simulate/visibility/slices/quad.h"
#include "simulate/visibility/slices/quad_samples.h"
#include "simulate/visibility/slices/span_outline.h"

namespace sonarsim {

/// Converts the strips of slices to quadrilaterals, and these to the samples of beams. A strip is
/// divided at the borders of beams. If two adjacent strips show the same surface between the same
/// lines, their quadrilaterals are joined. If surface ends within its strip, the surface of the
/// adjacent slice continues up to that end.
class StripQuads {
  public:
    /// All arguments must outlive it.
    StripQuads(const FrameScan& scan, const PatchLimits& limits, Samples& samples);

    /// Adds the strip of a slice. Strips must be added from low u to high, without gaps.
    void add(const SliceResult& result);

  private:
    /// The part of a span's strip that its surface does not reach.
    struct UncoveredPart {
        QuadSide low, high;
    };

    void add_between(const SliceResult& result, const MovedEnds& low, const MovedEnds& high);
    void end_beam();
    void add_span(const Slice& slice, const VisibleSpan& span, const SpanOutline& outline);
    void fill_holes(float u);
    void fill(const UncoveredPart& hole, const Quad& quad, const QuadSide& near,
              const QuadSide& far);
    void join(float u);
    bool go_on(const Quad& open, const Quad& quad) const;

    const FrameScan& scan_;
    const float max_wedge_m_;
    Samples& samples_;
    QuadSampler out_;
    const float widest_;           ///< greatest width of a quadrilateral, in u at u = 0
    std::vector<Quad> open_;       ///< quadrilaterals at the last strip's end, by w
    std::vector<Quad> new_quads_;  ///< quadrilaterals of this strip
    std::vector<UncoveredPart> last_uncovered_;  ///< holes of the last strip that reach its end
    std::vector<UncoveredPart> begin_;           ///< holes of this strip that reach its begin
    std::vector<UncoveredPart> end_;             ///< holes of this strip that reach its end
    MovedEnds at_border_[2];                     ///< ends of a strip at the borders of beams in it
    int beam_ = 0;  ///< beam of the frame in which the next strip begins
};

}  // namespace sonarsim
