#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "trace/target_surface.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The motion of a sonar while the sound of a ping is under way, at constant rates in its own frame
/// at transmission.
struct PingMotion {
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();
    double sound_speed_m_s = 0.0;  ///< 0: the sonar stands still

    bool is_still() const {
        return !(sound_speed_m_s > 0.0) || (velocity_m_s.isZero(0.0) && turn_rad_s.isZero(0.0));
    }
};

/// The place that a moving sonar measures for one in its frame at transmission. The range is half
/// of the way there from the place of transmission and back to that of reception. The direction is
/// that from the pose of reception in a fan, whose array measures it. In a side-scan sonar or a
/// cone, where only the product of transmitting and receiving pattern counts, it is that from the
/// pose half way between them.
Eigen::Vector3d measured_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& place);

/// The place that is measured so: the inverse of measured_place().
Eigen::Vector3d unmoved_place(const PingMotion& motion, ViewShape shape,
                              const Eigen::Vector3d& measured);

/// Moves the visible surface of a sonar at rest to where the moving sonar measures it. In a fan
/// surface goes to the beam of its azimuth; what leaves the sector goes to `outside_sector`.
void move_in_ping(const PingMotion& motion, const View& view, Samples& samples,
                  std::vector<Sample>& outside_sector);
/// The same for facets of targets.
void move_in_ping(const PingMotion& motion, ViewShape shape, std::vector<TargetFacet>& facets);

}  // namespace sonarsim
