#include "trajectory/navigation.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

struct TwoNormals {
    double first, second;
};

/// Two independent draws of a standard normal distribution (Box and Muller).
TwoNormals two_normals(std::uint32_t pose, std::uint32_t item, PhiloxKey draws) {
    const PhiloxBlock words = philox({pose, item, 0, 0}, draws);
    const double radius = std::sqrt(-2.0 * logarithm(1.0 - unit_double(words.x0, words.x1)));
    const SinCos angle = sincos(2.0 * pi * unit_double(words.x2, words.x3));
    return {radius * angle.cos, radius * angle.sin};
}

// The counter of a pose's draws is the number of the pose + 1; 0 is for draws that are made once.
constexpr std::uint32_t once = 0;

}  // namespace

bool NavigationErrors::is_on() const {
    return position_m > 0.0 || depth_m > 0.0 || tilt_rad > 0.0 || heading_rad > 0.0 ||
           heading_bias_rad > 0.0 || heading_drift_rad_s > 0.0 || speed_scale > 0.0;
}

Trajectory reported_poses(const Trajectory& truth, const NavigationErrors& errors,
                          PhiloxKey draws) {
    Trajectory out = truth;
    if (truth.empty()) return out;
    const TwoNormals of_heading = two_normals(once, 0, draws);
    const double bias = errors.heading_bias_rad * of_heading.first;
    const double drift = errors.heading_drift_rad_s * of_heading.second;
    const double scale = 1.0 + errors.speed_scale * two_normals(once, 1, draws).first;
    const double start_s = truth.front().t_s;
    const auto heading_error = [&](double t_s) { return bias + drift * (t_s - start_s); };

    Eigen::Vector3d track = truth.front().T_world_vehicle.translation;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Pose& pose = truth[i].T_world_vehicle;
        if (i > 0) {
            const Eigen::Vector3d step =
                pose.translation - truth[i - 1].T_world_vehicle.translation;
            const SinCos turn = sincos(heading_error(0.5 * (truth[i].t_s + truth[i - 1].t_s)));
            track.x() += scale * (turn.cos * step.x() - turn.sin * step.y());
            track.y() += scale * (turn.sin * step.x() + turn.cos * step.y());
        }
        const auto counter = static_cast<std::uint32_t>(i) + 1;
        const TwoNormals of_position = two_normals(counter, 0, draws);
        const TwoNormals of_tilt = two_normals(counter, 1, draws);
        const TwoNormals of_others = two_normals(counter, 2, draws);
        Pose& reported = out[i].T_world_vehicle;
        reported.translation = {track.x() + errors.position_m * of_position.first,
                                track.y() + errors.position_m * of_position.second,
                                pose.translation.z() + errors.depth_m * of_others.first};
        const double yaw = heading_error(truth[i].t_s) + errors.heading_rad * of_others.second;
        reported.rotation = (rotation_from_rpy(0.0, 0.0, yaw) * pose.rotation *
                             rotation_from_rpy(errors.tilt_rad * of_tilt.first,
                                               errors.tilt_rad * of_tilt.second, 0.0))
                                .normalized();
    }
    return out;
}

}  // namespace sonarsim
