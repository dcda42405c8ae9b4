#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/pose.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The motion of a sonar while the sound of a ping is under way, at constant rates in its own frame
/// at transmission.
struct PingMotion {
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();
    double sound_speed_m_s = 0.0;  ///< 0: the sonar stands still
    /// False for a fan of one beam, as of a scanning sonar, which measures no direction.
    bool measures_direction = true;

    bool is_still() const {
        return !(sound_speed_m_s > 0.0) || (velocity_m_s.isZero(0.0) && turn_rad_s.isZero(0.0));
    }
};

/// The rotation about a vector by its length in radians.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& turn_rad);

/// The same motion in the sonar's frame at a later transmission.
PingMotion motion_after(const PingMotion& motion, double later_s);
/// The pose of the sonar at that transmission.
Pose pose_after(const PingMotion& motion, const Pose& T_world_sensor, double later_s);

/// The place that a moving sonar measures for `place`, which is in its frame at transmission. The
/// range is half of the path out from the pose of transmission and back to the pose of reception.
/// The array of a fan measures the direction from the pose of reception. In a side-scan sonar or a
/// cone only the product of the transmitting and receiving patterns matters, so the direction is
/// that from the pose half way between them.
Eigen::Vector3d measured_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& place);

/// The inverse of measured_place().
Eigen::Vector3d unmoved_place(const PingMotion& motion, ViewShape shape,
                              const Eigen::Vector3d& measured);

/// Moves the samples of a sonar at rest to where the moving sonar measures them. The visible
/// surface of a fan is then sorted into beams again.
void move_in_ping(const PingMotion& motion, const View& view, Samples& samples);

}  // namespace sonarsim
