#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/pose.h"
#include "trace/doppler_loss.h"
#include "trace/target_surface.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The motion of a sonar while the sound of a ping is under way, at constant rates in its own frame
/// at transmission.
struct PingMotion {
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();
    double sound_speed_m_s = 0.0;  ///< 0: the sonar stands still
    /// A pulse that sweeps measures a place too far by this times the speed at which it recedes.
    double doppler_s = 0.0;
    /// The loss of the pulse's filter for a shifted echo.
    DopplerLoss loss = {};

    bool is_still() const {
        return !(sound_speed_m_s > 0.0) || (velocity_m_s.isZero(0.0) && turn_rad_s.isZero(0.0));
    }
};

/// The rotation by a vector's length about it.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& turn_rad);

/// The motion as the sonar has it at a later transmission, in its frame of then.
PingMotion motion_after(const PingMotion& motion, double later_s);
/// The pose of the sonar then.
Pose pose_after(const PingMotion& motion, const Pose& T_world_sensor, double later_s);

/// The place that a moving sonar measures for one in its frame at transmission. The range is half
/// of the way there from the place of transmission and back to that of reception, with the shift of
/// a pulse that sweeps. The direction is
/// that from the pose of reception in a fan, whose array measures it. In a side-scan sonar or a
/// cone, where only the product of transmitting and receiving pattern counts, it is that from the
/// pose half way between them.
Eigen::Vector3d measured_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& place);

/// The place that is measured so: the inverse of measured_place().
Eigen::Vector3d unmoved_place(const PingMotion& motion, ViewShape shape,
                              const Eigen::Vector3d& measured);

/// Gives the samples of a fan to the beams of their azimuths; what lies outside the sector goes to
/// `outside_sector`, and what lies there may come from it.
void sort_into_beams(const View& view, Samples& samples, std::vector<Sample>& outside_sector);

/// Moves the visible surface of a sonar at rest to where the moving sonar measures it. In a fan
/// surface goes to the beam of its azimuth; what leaves the sector goes to `outside_sector`.
void move_in_ping(const PingMotion& motion, const View& view, Samples& samples,
                  std::vector<Sample>& outside_sector);
/// The same for facets of targets.
void move_in_ping(const PingMotion& motion, ViewShape shape, std::vector<TargetFacet>& facets);

}  // namespace sonarsim
