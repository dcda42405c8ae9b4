#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/engine.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/moved_ends.h"
#include "visibility/slices/piece_limits.h"

namespace sonarsim {

/// Turns the visible spans of a slice into samples of what lies around it.
class SpanSampler {
  public:
    /// All arguments must outlive it.
    SpanSampler(const FrameScan& scan, const PieceLimits& limits, std::vector<Sample>& out);

    /// Adds what a slice stands for between two verticals of the picture plane, to which its ends
    /// are moved.
    void add(const SeenSlice& seen, const MovedEnds& low, const MovedEnds& high);

  private:
    struct Points;
    struct Quad;

    /// A side of a quadrilateral in the picture plane.
    struct QuadSide {
        float u;
        float low, high;  ///< w of its ends
    };

    void add_span(const Slice& slice, const VisibleSpan& span, const QuadSide& low,
                  const QuadSide& high);
    static QuadSide quad_side(const Slice& slice, const MovedEnds& side, std::size_t span);
    void cut(const Quad& quad);
    bool is_small(const Points& corners) const;
    void add_narrow(const Quad& quad, float from, float to);
    void add_piece(const Quad& quad, float from, float to);
    void add_piece(const Quad& quad, const Points& corners, float from, float to);
    void add_sample(const Quad& quad, const Points& corners);

    const FrameScan& scan_;
    const PieceLimits limits_;
    const bool any_width_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
