#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/engine.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/envelope.h"

namespace sonarsim {

/// How far a piece may be from a parallelogram whose range is linear.
struct PieceLimits {
    float sag_m;        ///< by which its range may miss the linear one
    float excess_m;     ///< by which its parallelogram may reach over more range than it does
    float shortest_m;   ///< no piece is cut shorter
    float range_max_m;  ///< nothing beyond is needed
};

PieceLimits piece_limits(const View& view);

/// Turns the visible spans of a slice into samples of one of its strips.
class SpanSampler {
  public:
    SpanSampler(const ClusterMesh& mesh, const SliceFrame& frame, const SliceScene& scene,
                const PieceLimits& limits, std::vector<Sample>& out);

    void add(const Slice& slice, const Strip& strip, std::span<const VisibleSpan> spans);

  private:
    struct Quad;

    /// A side of a quadrilateral in the picture plane.
    struct QuadSide {
        float u;
        float low, high;  ///< w of its ends
    };

    /// An end of a span, moved to one side of a strip.
    struct End {
        float at_slice;    ///< w
        float alone;       ///< w that it moves to by itself
        float w;           ///< that it is moved to
        float q;           ///< of the surface that it follows
        std::uint32_t by;  ///< the end that it follows
    };

    /// The ends of all spans of a slice at one side of a strip, two per span.
    struct Side {
        float u;
        std::vector<End> ends;
    };

    void add_span(const Slice& slice, const Strip& strip, const VisibleSpan& span,
                  std::size_t index);
    static void move_ends(const Slice& slice, std::span<const VisibleSpan> spans, float u,
                          Side& side);
    static QuadSide quad_side(const Slice& slice, const Side& side, std::size_t span);
    void add_span(const Slice& slice, const VisibleSpan& span, std::size_t index);
    void cut(const Quad& quad);
    void add_piece(const Quad& quad, float from, float to);
    void add_sample(const Quad& quad, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                    const Eigen::Vector3f& c, const Eigen::Vector3f& d);

    const ClusterMesh& mesh_;
    const SliceFrame& frame_;
    const SliceScene& scene_;
    const PieceLimits limits_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    Side low_;
    Side high_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
