#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/slices/edge_bin_error.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/patch_limits.h"
#include "visibility/slices/quad.h"

namespace sonarsim {

/// Converts quadrilaterals of the picture plane to samples, and reports them to `edge_bins`.
class QuadSampler {
  public:
    /// All arguments must outlive it.
    QuadSampler(const FrameScan& scan, std::span<const Material> materials,
                const PatchLimits& limits, EdgeBinError& edge_bins, std::vector<Sample>& out);

    void add(const Quad& quad);

  private:
    bool is_small(const QuadPoints& corners) const;
    void add_narrow(const Quad& quad, float from, float to);
    void add_patch(const Quad& quad, float from, float to);
    void add_patch(const Quad& quad, const QuadPoints& corners, float from, float to);
    void add_sample(const Quad& quad, const QuadPoints& corners);

    const FrameScan& scan_;
    const std::span<const Material> materials_;
    EdgeBinError& edge_bins_;
    const PatchLimits limits_;
    const bool any_width_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
