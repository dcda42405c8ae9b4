#pragma once

#include "visibility/engine.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// Divides the strips of slices at the borders of beams.
class BeamCutter {
  public:
    /// All arguments must outlive it.
    BeamCutter(const SliceFrame& frame, StripQuads& quads, Samples& samples);

    /// Adds the samples of a strip. Strips must be added from low u to high, without gaps.
    void add(const SliceResult& result);

  private:
    void end_beam();

    const SliceFrame& frame_;
    StripQuads& quads_;
    Samples& samples_;
    MovedEnds at_border_[2];
    int beam_ = 0;  ///< beam of the frame in which the next strip begins
};

}  // namespace sonarsim
