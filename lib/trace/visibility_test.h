#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/pose.h"
#include "trace/arrivals.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Finds which points are visible to the sonar.
class VisibilityTest {
  public:
    /// Returns the number of the point.
    std::size_t add(const Eigen::Vector3d& point) {
        const double range = arrival_range(point.cast<float>());
        rays_.push_back({Eigen::Vector3f::Zero(), (point / range).cast<float>()});
        ranges_.push_back(range);
        return rays_.size() - 1;
    }

    void trace(const VisibilityEngine& engine, const Pose& T_world_sensor) {
        hits_.resize(rays_.size());
        engine.intersect(T_world_sensor, rays_, hits_);
    }

    bool visible(std::size_t i) const {
        const Intersection& hit = hits_[i];
        return hit.distance_m >= (1.0 - hiding_share) * ranges_[i] - hit.rounding_m;
    }

  private:
    // Surface nearer than a point by more than this share of the range hides it.
    static constexpr double hiding_share = 1e-3;

    std::vector<Ray> rays_;
    std::vector<double> ranges_;
    std::vector<Intersection> hits_;
};

}  // namespace sonarsim
