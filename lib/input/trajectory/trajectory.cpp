#include "input/trajectory/trajectory.h"

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

void require_poses(const Trajectory& trajectory) {
    if (trajectory.empty()) throw InputError("a trajectory needs at least one pose");
}

}  // namespace

Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to,
                         double fraction) {
    const Eigen::Vector4d& a = from.coeffs();
    const Eigen::Vector4d b = a.dot(to.coeffs()) < 0.0 ? -to.coeffs() : to.coeffs();
    const double angle = 2.0 * arctan2((b - a).norm(), (b + a).norm());
    // At smaller angles the quotient of sines nears 0 / 0, and a straight line equals the arc.
    if (angle < 1e-6) return Eigen::Quaterniond(a + fraction * (b - a)).normalized();
    const double whole = sincos(angle).sin;
    const double share_a = sincos((1.0 - fraction) * angle).sin / whole;
    const double share_b = sincos(fraction * angle).sin / whole;
    return Eigen::Quaterniond(share_a * a + share_b * b).normalized();
}

TimedPose interpolate(const Trajectory& trajectory, double t_s) {
    require_poses(trajectory);
    const double first = trajectory.front().t_s;
    const double last = trajectory.back().t_s;
    if (!(t_s >= first && t_s <= last)) {
        throw InputError(fmt::format("no pose at {} s: the trajectory runs from {} to {} s",
                                     number_text(t_s), number_text(first), number_text(last)));
    }
    const auto next =
        std::upper_bound(trajectory.begin(), trajectory.end(), t_s,
                         [](double t, const TimedPose& pose) { return t < pose.t_s; });
    const TimedPose& before = *(next - 1);
    if (before.t_s == t_s) return before;
    const Pose& a = before.T_world_vehicle;
    const Pose& b = next->T_world_vehicle;
    const double fraction = (t_s - before.t_s) / (next->t_s - before.t_s);
    return {t_s,
            {slerp(a.rotation, b.rotation, fraction),
             a.translation + fraction * (b.translation - a.translation)}};
}

Trajectory resample(const Trajectory& trajectory, double rate_hz) {
    require_poses(trajectory);
    if (rate_hz == 0.0) return trajectory;
    const double first = trajectory.front().t_s;
    const double last = trajectory.back().t_s;
    const double rounding =
        2.0 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(first), std::fabs(last));
    const double tolerance = 1e-9 + rounding;
    if (rate_hz * 4.0 * tolerance > 1.0) {
        throw InputError(fmt::format(
            "rate_hz of {} is too high: near {} s neighbouring poses would have equal times",
            number_text(rate_hz), number_text(last)));
    }
    const double steps = std::floor((last - first + tolerance) * rate_hz);
    if (steps + 1.0 > static_cast<double>(max_poses)) {
        throw InputError(fmt::format(
            "rate_hz of {} gives {} poses over {} s; at most {} are allowed", number_text(rate_hz),
            number_text(steps + 1.0), number_text(last - first), max_poses));
    }
    Trajectory out(static_cast<std::size_t>(steps) + 1);
    for (std::size_t k = 0; k < out.size(); ++k) {
        const double t_s = first + static_cast<double>(k) / rate_hz;
        out[k] = {t_s, interpolate(trajectory, std::min(t_s, last)).T_world_vehicle};
    }
    return out;
}

}  // namespace sonarsim
