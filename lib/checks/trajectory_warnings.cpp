#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <variant>

#include "checks/find_warnings.h"
#include "core/pose.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double full_turn_rad = 2.0 * pi;

double turn_deg(double from, double to) {
    return std::fabs(std::remainder(to - from, 360.0));
}

/// The mean angle between heading and track along the trajectory, degrees: with the headings as
/// they are written, and with their numbers read as radians.
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
        const double yaw = degrees(rpy_from_rotation(trajectory[i].T_world_vehicle.rotation).yaw);
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

/// True for the angles that people type in radians: whole quarters of a turn.
bool is_quarter_turn_rad(double value) {
    const double quarters = value / (0.5 * pi);
    return quarters > 0.5 && std::fabs(quarters - std::round(quarters)) < 1e-3;
}

void judge_radians(const Trajectory& trajectory, std::vector<Warning>& out) {
    double largest = 0.0;
    for (const TimedPose& pose : trajectory) {
        const Rpy attitude = rpy_from_rotation(pose.T_world_vehicle.rotation);
        for (const double angle : {attitude.roll, attitude.pitch, attitude.yaw})
            largest = std::max(largest, std::fabs(degrees(angle)));
    }
    if (largest == 0.0 || largest > 1.001 * full_turn_rad) return;
    const HeadingErrors errors = heading_errors(trajectory);
    const std::string what = fmt::format("its attitudes, all within {:.4g} degrees,", largest);
    // docs/warnings.md says why these are the limits.
    if (errors.as_degrees > 30.0 && errors.as_radians < 15.0) {
        out.push_back(
            make_warning(WarningCode::radians, "trajectory", what,
                         fmt::format("headings are {:.0f} degrees off the track, as radians {:.0f}",
                                     errors.as_degrees, errors.as_radians)));
    } else if (is_quarter_turn_rad(largest)) {
        out.push_back(make_warning(WarningCode::radians, "trajectory", what,
                                   fmt::format("{:.5g} is a multiple of a quarter turn", largest)));
    }
}

/// True if the vehicle lies on its side or on its back.
bool is_toppled(const Eigen::Quaterniond& rotation) {
    constexpr double half_right_angle_cosine = 0.7071;
    return rotation.toRotationMatrix()(2, 2) < half_right_angle_cosine;
}

/// True if a trajectory's file has roll, pitch and yaw instead of quaternions.
bool has_angles(const std::filesystem::path& file) {
    std::ifstream text(file);
    std::string header;
    return file.extension() == ".csv" && std::getline(text, header) &&
           header.find("roll_deg") != std::string::npos;
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
    out.push_back(make_warning(WarningCode::quaternion_order, "trajectory", toppled,
                               trajectory.size(), upright_else));
}

}  // namespace

std::vector<Warning> trajectory_warnings(const TrajectoryConfig& config,
                                         const Trajectory& trajectory) {
    std::vector<Warning> out;
    if (!std::holds_alternative<LawnmowerTrajectoryConfig>(config)) judge_radians(trajectory, out);
    const auto* const poses = std::get_if<FileTrajectoryConfig>(&config);
    if (poses && !has_angles(poses->file)) judge_order(trajectory, out);
    return out;
}

}  // namespace sonarsim
