#pragma once

#include <span>

#include "simulate/calibrated/equation/patches.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// The strengths of a scene's map at pieces of a ping's samples (MapStrengths::at_points). Samples
/// that are cut by texels would be many times as many.
class PieceStrengths {
  public:
    PieceStrengths(const TracedPing& traced, const Scene& scene, ViewShape shape);

    /// Multiplies the powers of pieces of `surface` by the mean strengths over these pieces, into
    /// which samples were cut by `limits`; null: the pieces are points.
    void apply(std::span<const Sample> surface, const PatchBlock& pieces, const PointLimits* limits,
               PatchBlock::Array<float>& power) const;
    /// The strength at the centre of a sample.
    float at(const Sample& sample) const;

  private:
    Eigen::Vector2d ground_of(const Eigen::Vector3f& point) const;
    Eigen::Vector2d half_of_piece(const Sample& sample, const PointLimits& limits) const;

    const GroundMaps* maps_;  ///< null: the samples have their strengths
    TruePlaces places_;
    Eigen::Matrix<double, 2, 3> R_;  ///< from the sensor frame to the world's x and y
};

}  // namespace sonarsim
