#pragma once

#include <vector>

#include "visibility/slices/frame_scan.h"
#include "visibility/slices/moved_ends.h"
#include "visibility/slices/quad.h"
#include "visibility/slices/quad_samples.h"

namespace sonarsim {

/// Turns the strips that slices stand for into quadrilaterals. Where two strips meet that show the
/// same surface between the same lines, its quadrilateral goes on from one into the other.
class StripQuads {
  public:
    /// All arguments must outlive it.
    StripQuads(const FrameScan& scan, const PieceLimits& limits, QuadSampler& out);

    /// Adds what a slice stands for between two verticals of the picture plane, to which its ends
    /// are moved. Strips are to be added from low u to high.
    void add(const SeenSlice& seen, const MovedEnds& low, const MovedEnds& high);

    /// Hands over what goes on: the next strip lies in another beam.
    void end_beam();

  private:
    void add_span(const Slice& slice, const VisibleSpan& span, const QuadSide& low,
                  const QuadSide& high);
    void join(float u);
    bool go_on(const Quad& open, const Quad& quad) const;

    const FrameScan& scan_;
    const float most_wedge_m_;
    QuadSampler& out_;
    const float widest_;       ///< that a quadrilateral becomes, in u at u = 0
    std::vector<Quad> open_;   ///< that end with the last strip, from low w to high
    std::vector<Quad> fresh_;  ///< of the strip that is being added
};

}  // namespace sonarsim
