#pragma once

#include <Eigen/Core>

#include "core/pose.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

enum class Containment { outside, partly, inside };

/// The volume that a ping views. Points are given in local axes relative to the sensor.
class ViewVolume {
  public:
    ViewVolume(const View& view, const Pose& T_local_sensor);

    /// Position of the ball relative to the volume. `outside` and `inside` are certain.
    Containment containment(const Eigen::Vector3f& centre, float radius) const {
        return of_sensor_frame(R_sensor_local_ * centre, radius);
    }

    /// The same for a cube, by the ball around it: slightly more than half its diagonal, for
    /// rounding.
    Containment of_cube(const Eigen::Vector3f& centre, float edge) const {
        return containment(centre, 0.8661F * edge + rounding_m());
    }

    /// The same with `centre` in the sensor frame.
    Containment of_sensor_frame(const Eigen::Vector3f& centre, float radius) const;

    /// More than the error of a position within the range: four roundings of 6e-8 of the range.
    float rounding_m() const { return 1e-6F * reach_m_; }

    const Eigen::Vector3d& position() const { return position_; }
    const Eigen::Matrix3f& R_sensor_local() const { return R_sensor_local_; }

  private:
    Eigen::Matrix3f R_sensor_local_;
    Eigen::Vector3d position_;  ///< position of the sensor, scene-local
    float reach_m_;
    float sin_azimuth_, cos_azimuth_;  ///< half the opening angle; the same for elevation
    float sin_elevation_, cos_elevation_;
};

}  // namespace sonarsim
