#pragma once

#include <cstddef>
#include <vector>

#include "visibility/engine.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// Divides the strips of slices at the borders of beams.
class BeamCutter {
  public:
    /// All arguments must outlive it. `keeps_compared`: Samples::compared is filled.
    BeamCutter(const SliceFrame& frame, StripQuads& quads, BeamErrors& errors, Samples& samples,
               bool keeps_compared);

    /// Replaces the samples of the beam that is being cut by those of its check, or, at the end of
    /// a frame, those of its last beam.
    void replace(const std::vector<Sample>& by);

    /// Adds the samples of a strip. Strips must be added from low u to high, without gaps.
    void add(const SliceResult& result);

  private:
    void end_beam();
    void keep_compared(int beam_of_frame, std::size_t begin, const std::vector<Sample>& check);

    const SliceFrame& frame_;
    StripQuads& quads_;
    BeamErrors& errors_;
    Samples& samples_;
    const bool keeps_compared_;
    MovedEnds at_border_[2];
    int beam_ = 0;                ///< beam of the frame in which the next strip begins
    std::size_t begin_ = 0;       ///< its first sample
    std::size_t last_begin_ = 0;  ///< the first sample of the beam before it
    bool replaced_ = false;
    std::vector<Sample> by_;  ///< its samples if it is replaced
};

}  // namespace sonarsim
