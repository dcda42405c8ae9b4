#pragma once

#include <Eigen/Core>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

enum class Containment { outside, partly, inside };

/// The part of space that a ping looks at. Points are given in local axes relative to the sensor.
class ViewVolume {
  public:
    ViewVolume(const View& view, const Pose& T_local_sensor);

    /// Where the ball lies. `outside` and `inside` are certain.
    Containment containment(const Eigen::Vector3f& centre, float radius) const {
        return of_sensor_frame(R_sensor_local_ * centre, radius);
    }

    /// The same, `centre` in the frame of the sensor.
    Containment of_sensor_frame(const Eigen::Vector3f& centre, float radius) const;

    /// More than the error of a place within the range: four roundings of 6e-8 of the range.
    float rounding_m() const { return 1e-6F * reach_m_; }

    const Eigen::Vector3d& position() const { return position_; }
    const Eigen::Matrix3f& R_sensor_local() const { return R_sensor_local_; }

  private:
    Eigen::Matrix3f R_sensor_local_;
    Eigen::Vector3d position_;  ///< of the sensor, scene-local
    float reach_m_;
    float sin_azimuth_, cos_azimuth_;  ///< of half the opening
    float sin_elevation_, cos_elevation_;
};

}  // namespace sonarsim
