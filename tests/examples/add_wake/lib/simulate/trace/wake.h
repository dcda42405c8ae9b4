#pragma once

#include <Eigen/Geometry>

#include "simulate/trace/sample_source.h"

namespace sonarsim {

/// A cloud of bubbles behind a ship. Sound loses power in it and comes back from it.
struct WakeConfig {
    Eigen::AlignedBox3d box_m;      ///< world
    float absorption_per_m = 0.0F;  ///< one way: power falls as e^-(absorption times length)
    float scattering_per_m = 0.0F;  ///< backscattering cross-section of a cubic metre, 1/m
    double cell_m = 0.25;           ///< one sample stands for a cube of this edge
};

/// The length of the straight way from `from` to `to` in the box, m.
double length_within(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                     const Eigen::Vector3d& to);

class Wake final : public SampleSource {
  public:
    /// `kind`: of its samples.
    Wake(const WakeConfig& config, SampleKind kind) : config_(config), kind_(kind) {}

    /// Also weakens the samples behind or in the wake.
    void add(const TraceContext& context, const PingMotion& motion, std::uint32_t pose,
             Samples& samples) const override;

  private:
    WakeConfig config_;
    SampleKind kind_;
};

}  // namespace sonarsim
