#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/piece_limits.h"
#include "visibility/slices/quad.h"
#include "visibility/slices/sliver_bins.h"

namespace sonarsim {

/// Turns quadrilaterals of the picture plane into samples, of which it tells `slivers`.
class QuadSampler {
  public:
    /// All arguments must outlive it.
    QuadSampler(const FrameScan& scan, std::span<const Material> materials,
                const PieceLimits& limits, SliverBins& slivers, std::vector<Sample>& out);

    void add(const Quad& quad);

  private:
    bool is_small(const QuadPoints& corners) const;
    void add_narrow(const Quad& quad, float from, float to);
    void add_piece(const Quad& quad, float from, float to);
    void add_piece(const Quad& quad, const QuadPoints& corners, float from, float to);
    void add_sample(const Quad& quad, const QuadPoints& corners);

    const FrameScan& scan_;
    const std::span<const Material> materials_;
    SliverBins& slivers_;
    const PieceLimits limits_;
    const bool any_width_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
