#include "input/trajectory/patterns.h"

#include <array>

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr int max_lines = 100'000;

/// The corners of the survey's rectangle, in order: x along the heading, y to port.
std::array<Eigen::Vector2d, 4> corners_along(const LawnmowerTrajectoryConfig& survey,
                                             const SinCos& heading) {
    const Eigen::Vector2d lo(survey.area_min_m.data());
    const Eigen::Vector2d hi(survey.area_max_m.data());
    std::array<Eigen::Vector2d, 4> corners{lo, {hi.x(), lo.y()}, hi, {lo.x(), hi.y()}};
    for (Eigen::Vector2d& corner : corners) {
        corner = {heading.cos * corner.x() + heading.sin * corner.y(),
                  heading.cos * corner.y() - heading.sin * corner.x()};
    }
    return corners;
}

struct Interval {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();

    void include(double value) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
};

/// The interval of x that a polygon covers within a strip of y.
Interval reach_in_strip(const std::array<Eigen::Vector2d, 4>& corners, const Interval& strip) {
    Interval reach;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d& a = corners[i];
        const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
        if (a.y() >= strip.lo && a.y() <= strip.hi) reach.include(a.x());
        for (const double edge : {strip.lo, strip.hi}) {
            if ((a.y() < edge) == (b.y() < edge)) continue;
            reach.include(a.x() + (edge - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
    }
    return reach;
}

/// Drops the poses between the lines of a survey, which have three waypoints each after the first
/// two: half-way, start and end of the next line. The other poses keep their times.
void drop_turns(std::span<const Pose> waypoints, const LawnmowerTrajectoryConfig& survey,
                Trajectory& poses) {
    constexpr double rounding_s = 1e-9;
    std::vector<double> t_s{0.0};
    for (std::size_t k = 1; k < waypoints.size(); ++k) {
        const double leg_m = (waypoints[k].translation - waypoints[k - 1].translation).norm();
        t_s.push_back(t_s.back() + leg_m / survey.speed_m_s);
    }
    std::erase_if(poses, [&, line_end = std::size_t{1}](const TimedPose& pose) mutable {
        while (line_end + 3 < t_s.size() && pose.t_s >= t_s[line_end + 2] - rounding_s)
            line_end += 3;
        return line_end + 3 < t_s.size() && pose.t_s > t_s[line_end] + rounding_s;
    });
}

constexpr std::uint32_t cosines = 64;

struct Cosine {
    double rad_per_s;
    double phase;
};

std::vector<Cosine> draw_cosines(std::uint32_t movement, const MotionConfig& motion,
                                 PhiloxKey draws) {
    std::vector<Cosine> out;
    for (std::uint32_t k = 0; k < cosines; ++k) {
        const PhiloxBlock words = philox({movement, k, 0, 0}, draws);
        // Keep the share off 0 and 1, so that its logarithm is finite and not 0.
        const double share =
            std::clamp((k + unit_double(words.x0, words.x1)) / cosines, 1e-9, 1.0 - 1e-9);
        const double peak_ratio = std::sqrt(std::sqrt(1.25 / -logarithm(share)));
        const double rad_per_s = 2.0 * pi * peak_ratio / motion.period_s;
        out.push_back({rad_per_s, 2.0 * pi * unit_double(words.x2, words.x3)});
    }
    return out;
}

double sum_at(const std::vector<Cosine>& spectrum, double t_s) {
    double sum = 0.0;
    for (const Cosine& one : spectrum)
        sum += sincos(one.rad_per_s * t_s + one.phase).cos;
    return sum * std::sqrt(2.0 / cosines);
}

}  // namespace

Trajectory follow_waypoints(std::span<const Pose> waypoints, double speed_m_s, double rate_hz) {
    Trajectory knots;
    for (const Pose& waypoint : waypoints) {
        double t_s = 0.0;
        if (!knots.empty()) {
            const TimedPose& last = knots.back();
            const double length = (waypoint.translation - last.T_world_vehicle.translation).norm();
            t_s = last.t_s + length / speed_m_s;
            if (!(t_s > last.t_s)) {
                throw InputError(fmt::format(
                    "waypoint {} has the position of the one before: a leg needs a length (turn "
                    "along a leg, not on the spot)",
                    knots.size() + 1));
            }
        }
        knots.push_back({t_s, {waypoint.rotation.normalized(), waypoint.translation}});
    }
    return resample(knots, rate_hz);
}

Trajectory lawnmower(const LawnmowerTrajectoryConfig& survey) {
    const double yaw = radians(survey.heading_deg);
    const SinCos heading = sincos(yaw);
    const auto corners = corners_along(survey, heading);
    Interval across;
    for (const Eigen::Vector2d& corner : corners)
        across.include(corner.y());

    const double width = across.hi - across.lo;
    const double spacing = survey.line_spacing_m;
    // 1e-9 keeps an exact multiple of the spacing from rounding up to one strip more.
    const double lines = std::max(1.0, std::ceil(width / spacing - 1e-9));
    if (lines > max_lines) {
        throw InputError(fmt::format("line_spacing_m of {} gives {} lines; at most {} are allowed",
                                     number_text(spacing), number_text(lines), max_lines));
    }
    const double first_line = across.lo + 0.5 * (width - (lines - 1.0) * spacing);

    const auto in_world = [&](double along, double to_port) {
        // GCC contracts such a pair of products even where contraction is off.
        return Eigen::Vector3d(std::fma(heading.cos, along, -(heading.sin * to_port)),
                               std::fma(heading.sin, along, heading.cos * to_port), survey.z_m);
    };
    const auto turned = [&](double angle) { return rotation_from_rpy(0.0, 0.0, yaw + angle); };
    std::vector<Pose> waypoints;
    for (int line = 0; line < static_cast<int>(lines); ++line) {
        const double y = first_line + line * spacing;
        const Interval reach = reach_in_strip(corners, {y - 0.5 * spacing, y + 0.5 * spacing});
        const bool forth = line % 2 == 0;
        const Eigen::Vector3d start = in_world(forth ? reach.lo : reach.hi, y);
        const Eigen::Vector3d end = in_world(forth ? reach.hi : reach.lo, y);
        const Eigen::Quaterniond attitude = turned(forth ? 0.0 : pi);
        // A half turn has two shortest arcs; a waypoint half-way chooses the one over port.
        if (line > 0)
            waypoints.push_back({turned(0.5 * pi), 0.5 * (waypoints.back().translation + start)});
        waypoints.push_back({attitude, start});
        waypoints.push_back({attitude, end});
    }
    Trajectory poses = follow_waypoints(waypoints, survey.speed_m_s, survey.rate_hz);
    if (!survey.turns) drop_turns(waypoints, survey, poses);
    return poses;
}

void add_wave_motion(const MotionConfig& motion, PhiloxKey draws, Trajectory& poses) {
    const auto moves = [](double deviation) { return deviation > 0.0; };
    if (poses.empty() || !(std::ranges::any_of(motion.position_m, moves) ||
                           std::ranges::any_of(motion.turn_deg, moves)))
        return;
    std::array<std::vector<Cosine>, 6> spectra;
    for (std::uint32_t movement = 0; movement < spectra.size(); ++movement)
        spectra[movement] = draw_cosines(movement, motion, draws);
    const double start_s = poses.front().t_s;
    for (TimedPose& pose : poses) {
        const auto moved = [&](std::size_t movement, double deviation) {
            return deviation > 0.0 ? deviation * sum_at(spectra[movement], pose.t_s - start_s)
                                   : 0.0;
        };
        Eigen::Vector3d shift, rpy;
        for (int axis = 0; axis < 3; ++axis) {
            shift[axis] = moved(axis, motion.position_m[axis]);
            rpy[axis] = moved(3 + axis, radians(motion.turn_deg[axis]));
        }
        const Pose wave{rotation_from_rpy(rpy.x(), rpy.y(), rpy.z()), shift};
        pose.T_world_vehicle = pose.T_world_vehicle * wave;
    }
}

Trajectory reported_poses(const Trajectory& truth, const NavigationConfig& errors,
                          PhiloxKey draws) {
    Trajectory out = truth;
    for (std::size_t i = 0; i < out.size(); ++i) {
        // Counter 0 is left out, so that poses keep their draws.
        const auto counter = static_cast<std::uint32_t>(i) + 1;
        const auto position_draws = two_normals(philox({counter, 0, 0, 0}, draws));
        const auto tilt_draws = two_normals(philox({counter, 1, 0, 0}, draws));
        const auto other_draws = two_normals(philox({counter, 2, 0, 0}, draws));
        Pose& pose = out[i].T_world_vehicle;
        pose.translation += Eigen::Vector3d(errors.position_m * position_draws.first,
                                            errors.position_m * position_draws.second,
                                            errors.depth_m * other_draws.first);
        pose.rotation =
            (rotation_from_rpy(0.0, 0.0, radians(errors.heading_deg) * other_draws.second) *
             pose.rotation *
             rotation_from_rpy(radians(errors.tilt_deg) * tilt_draws.first,
                               radians(errors.tilt_deg) * tilt_draws.second, 0.0))
                .normalized();
    }
    return out;
}

}  // namespace sonarsim
