#pragma once

#include <vector>

#include "simulate/visibility/engine.h"
#include "simulate/visibility/slices/frame_scan.h"
#include "simulate/visibility/slices/patch_limits.h"
#include "simulate/visibility/slices/quad.h"

namespace sonarsim {

/// A line on a plane, from one border of a quadrilateral to the other. At the position s along it
/// the range is sqrt(h2 + s^2).
struct RangeLine {
    Eigen::Vector3f from;
    Eigen::Vector3f along;  ///< unit
    float length;
    float s0, s1;       ///< positions of its ends, m
    float h2;           ///< squared distance of the sonar from the line, m^2
    float near2, far2;  ///< squared ranges, m^2
};

/// Converts quadrilaterals of the picture plane to samples.
class QuadSampler {
  public:
    /// All arguments must outlive it.
    QuadSampler(const FrameScan& scan, const PatchLimits& limits, std::vector<Sample>& out);

    void add(const Quad& quad);

  private:
    bool is_small(const QuadPoints& corners) const;
    void cut_along(const Quad& quad);
    void find_cuts(const RangeLine& line);
    void cut_narrow(const Quad& quad, float from, float to);
    void add_part(const Quad& quad, float from, float to);
    void divide_across(const Quad& quad, const QuadPoints& corners);
    void push(const Quad& quad, const QuadPoints& corners);

    const FrameScan& scan_;
    const PatchLimits limits_;
    const bool any_width_;
    std::vector<Sample>& out_;
    const Eigen::Matrix3f R_sensor_frame_;
    std::vector<float> cuts_;
};

}  // namespace sonarsim
