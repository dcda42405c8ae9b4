#include "trajectory/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "core/input_limits.h"
#include "core/text.h"
#include "core/units.h"
#include "trajectory/interpolate.h"

namespace sonarsim {

namespace {

constexpr int most_lines = 100'000;

void require_positive(const char* name, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    throw InputError(std::string(name) + " must be a number above 0, not " + number_text(value));
}

void require_within(const char* name, double value, double limit) {
    if (std::fabs(value) <= limit) return;
    throw InputError(std::string(name) + " must be between " + number_text(-limit) + " and " +
                     number_text(limit) + ", not " + number_text(value));
}

/// The corners of the survey's rectangle, in order: x along the heading, y to port.
std::array<Eigen::Vector2d, 4> corners_along(const Lawnmower& survey, const SinCos& heading) {
    const Eigen::Vector2d& lo = survey.area_min_m;
    const Eigen::Vector2d& hi = survey.area_max_m;
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

void check(const Lawnmower& survey) {
    for (const double coordinate : survey.area_min_m) {
        require_within("area_min_m", coordinate, furthest_m);
    }
    for (const double coordinate : survey.area_max_m) {
        require_within("area_max_m", coordinate, furthest_m);
    }
    require_within("z_m", survey.z_m, furthest_m);
    require_within("heading_deg", survey.heading_deg, 360.0);
    require_positive("line_spacing_m", survey.line_spacing_m);
    if (!(survey.area_min_m.array() < survey.area_max_m.array()).all()) {
        throw InputError("area_max_m must be greater than area_min_m in x and in y");
    }
}

}  // namespace

Trajectory follow_waypoints(std::span<const Waypoint> waypoints, double speed_m_s, double rate_hz) {
    require_positive("speed_m_s", speed_m_s);
    Trajectory knots;
    knots.reserve(waypoints.size());
    for (const Waypoint& waypoint : waypoints) {
        const std::string number = std::to_string(knots.size() + 1);
        for (const double coordinate : waypoint.position_m) {
            require_within(("position_m of waypoint " + number).c_str(), coordinate, furthest_m);
        }
        if (!(std::fabs(waypoint.attitude.norm() - 1.0) < 1e-3)) {
            throw InputError("the attitude of waypoint " + number + " is not a unit quaternion");
        }
        double t_s = 0.0;
        if (!knots.empty()) {
            const TimedPose& last = knots.back();
            const double length = (waypoint.position_m - last.T_world_vehicle.translation).norm();
            t_s = last.t_s + length / speed_m_s;
            if (!(t_s > last.t_s)) {
                throw InputError("waypoint " + number + " has the position of the one before: " +
                                 "a leg needs a length (turn along a leg, not on the spot)");
            }
        }
        knots.push_back({t_s, {waypoint.attitude.normalized(), waypoint.position_m}});
    }
    return resample(knots, rate_hz);
}

Trajectory lawnmower(const Lawnmower& survey) {
    check(survey);
    const double yaw = radians(survey.heading_deg);
    const SinCos heading = sincos(yaw);
    const auto corners = corners_along(survey, heading);
    Interval across;
    for (const Eigen::Vector2d& corner : corners)
        across.include(corner.y());

    const double width = across.hi - across.lo;
    const double spacing = survey.line_spacing_m;
    // The subtracted 1e-9 keeps an exact multiple of the spacing from rounding up to one strip
    // more.
    const double lines = std::max(1.0, std::ceil(width / spacing - 1e-9));
    if (lines > most_lines) {
        throw InputError("line_spacing_m of " + number_text(spacing) + " gives " +
                         number_text(lines) + " lines; at most " + std::to_string(most_lines) +
                         " are allowed");
    }
    const double first_line = across.lo + 0.5 * (width - (lines - 1.0) * spacing);

    const auto in_world = [&](double along, double to_port) {
        // Explicit fma(): GCC contracts such a pair of products even where contraction is switched
        // off.
        return Eigen::Vector3d(std::fma(heading.cos, along, -(heading.sin * to_port)),
                               std::fma(heading.sin, along, heading.cos * to_port), survey.z_m);
    };
    const auto turned = [&](double angle) { return rotation_from_rpy(0.0, 0.0, yaw + angle); };
    std::vector<Waypoint> waypoints;
    for (int line = 0; line < static_cast<int>(lines); ++line) {
        const double y = first_line + line * spacing;
        const Interval reach = reach_in_strip(corners, {y - 0.5 * spacing, y + 0.5 * spacing});
        const bool forth = line % 2 == 0;
        const Eigen::Vector3d start = in_world(forth ? reach.lo : reach.hi, y);
        const Eigen::Vector3d end = in_world(forth ? reach.hi : reach.lo, y);
        const Eigen::Quaterniond attitude = turned(forth ? 0.0 : pi);
        // A half turn has two shortest arcs; a waypoint half-way chooses the one over port.
        if (line > 0) {
            waypoints.push_back({0.5 * (waypoints.back().position_m + start), turned(0.5 * pi)});
        }
        waypoints.push_back({start, attitude});
        waypoints.push_back({end, attitude});
    }
    return follow_waypoints(waypoints, survey.speed_m_s, survey.rate_hz);
}

}  // namespace sonarsim
