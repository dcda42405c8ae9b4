#include "survey/trajectory_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double full_turn_rad = 2.0 * pi;

/// The angles of rotation_from_rpy(), degrees.
std::array<double, 3> rpy_deg(const Eigen::Quaterniond& rotation) {
    const Eigen::Matrix3d r = rotation.toRotationMatrix();
    return {degrees(std::atan2(r(2, 1), r(2, 2))),
            degrees(-std::asin(std::clamp(r(2, 0), -1.0, 1.0))),
            degrees(std::atan2(r(1, 0), r(0, 0)))};
}

double turn_deg(double from, double to) {
    return std::fabs(std::remainder(to - from, 360.0));
}

/// How far headings are off the way that the vehicle goes, in the mean over that way, degrees. As
/// they stand, and with their numbers taken for radians.
struct HeadingErrors {
    double as_degrees = 0.0;
    double as_radians = 0.0;
};

HeadingErrors heading_errors(const Trajectory& trajectory) {
    HeadingErrors errors;
    double way = 0.0;
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
        const Eigen::Vector3d step = trajectory[i].T_world_vehicle.translation -
                                     trajectory[i - 1].T_world_vehicle.translation;
        const double length = step.head<2>().norm();
        const double track = degrees(std::atan2(step.y(), step.x()));
        const double yaw = rpy_deg(trajectory[i].T_world_vehicle.rotation)[2];
        errors.as_degrees += length * turn_deg(track, yaw);
        errors.as_radians += length * turn_deg(track, degrees(yaw));
        way += length;
    }
    if (way > 0.0) {
        errors.as_degrees /= way;
        errors.as_radians /= way;
    }
    return errors;
}

/// Angles that people type in radians: whole quarters of a turn.
bool is_quarter_turn_rad(double value) {
    const double quarters = value / (0.5 * pi);
    return quarters > 0.5 && std::fabs(quarters - std::round(quarters)) < 1e-3;
}

void judge_radians(const Trajectory& trajectory, std::vector<Warning>& out) {
    double largest = 0.0;
    for (const TimedPose& pose : trajectory) {
        for (const double angle : rpy_deg(pose.T_world_vehicle.rotation))
            largest = std::max(largest, std::fabs(angle));
    }
    if (largest == 0.0 || largest > 1.001 * full_turn_rad) return;
    const HeadingErrors errors = heading_errors(trajectory);
    if (errors.as_degrees > 30.0 && errors.as_radians < 15.0) {
        out.push_back(
            make_warning(Doubt::radians, "trajectory", largest,
                         fmt::format("headings are {:.0f} degrees off the way, as radians {:.0f}",
                                     errors.as_degrees, errors.as_radians)));
    } else if (is_quarter_turn_rad(largest)) {
        out.push_back(make_warning(Doubt::radians, "trajectory", largest,
                                   fmt::format("{:.5g} is a multiple of a quarter turn", largest)));
    }
}

/// Whether the vehicle lies on its side or on its back.
bool is_toppled(const Eigen::Quaterniond& rotation) {
    constexpr double half_right_angle_cosine = 0.7071;
    return rotation.toRotationMatrix()(2, 2) < half_right_angle_cosine;
}

void judge_order(const Trajectory& trajectory, std::vector<Warning>& out) {
    std::size_t toppled = 0;
    std::size_t upright_else = 0;
    for (const TimedPose& pose : trajectory) {
        const Eigen::Quaterniond& q = pose.T_world_vehicle.rotation;
        toppled += is_toppled(q);
        upright_else += !is_toppled(Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()));
    }
    if (2 * toppled < trajectory.size() || 10 * upright_else < 9 * trajectory.size()) return;
    out.push_back(make_warning(Doubt::quaternion_order, "trajectory", toppled, trajectory.size(),
                               upright_else));
}

}  // namespace

std::vector<Warning> trajectory_warnings(const TrajectoryConfig& config,
                                         const Trajectory& trajectory) {
    std::vector<Warning> out;
    if (!std::holds_alternative<LawnmowerTrajectoryConfig>(config)) judge_radians(trajectory, out);
    if (std::holds_alternative<FileTrajectoryConfig>(config)) judge_order(trajectory, out);
    return out;
}

}  // namespace sonarsim
