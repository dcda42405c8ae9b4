#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/engine.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/moved_ends.h"

namespace sonarsim {

/// How far a piece may be from a parallelogram whose range is linear.
struct PieceLimits {
    float sag_m;        ///< by which its range may miss the linear one
    float excess_m;     ///< by which its parallelogram may reach over more range than it does
    float shortest_m;   ///< no piece is cut shorter
    float range_max_m;  ///< nothing beyond is needed
};

PieceLimits piece_limits(const View& view);

/// Turns the visible spans of a slice into samples of what lies around it.
class SpanSampler {
  public:
    /// All arguments must outlive it.
    SpanSampler(const FrameScan& scan, const PieceLimits& limits, std::vector<Sample>& out);

    /// Adds what `slice` stands for between two verticals of the picture plane.
    void add(const Slice& slice, float u_low, float u_high, std::span<const VisibleSpan> spans);

  private:
    struct Quad;

    /// A side of a quadrilateral in the picture plane.
    struct QuadSide {
        float u;
        float low, high;  ///< w of its ends
    };

    void add_span(const Slice& slice, const VisibleSpan& span, std::size_t index);
    static QuadSide quad_side(const Slice& slice, const MovedEnds& side, std::size_t span);
    void cut(const Quad& quad);
    void add_piece(const Quad& quad, float from, float to);
    void add_sample(const Quad& quad, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                    const Eigen::Vector3f& c, const Eigen::Vector3f& d);

    const FrameScan& scan_;
    const PieceLimits limits_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    MovedEnds low_;
    MovedEnds high_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
