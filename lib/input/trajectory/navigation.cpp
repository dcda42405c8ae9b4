#include "input/trajectory/navigation.h"

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

}  // namespace

bool NavigationErrors::is_on() const {
    return position_m > 0.0 || depth_m > 0.0 || tilt_rad > 0.0 || heading_rad > 0.0;
}

Trajectory reported_poses(const Trajectory& truth, const NavigationErrors& errors,
                          PhiloxKey draws) {
    Trajectory out = truth;
    for (std::size_t i = 0; i < out.size(); ++i) {
        // Counter 0 is left out, so that poses keep their draws.
        const auto counter = static_cast<std::uint32_t>(i) + 1;
        const TwoNormals position_draws = two_normals(counter, 0, draws);
        const TwoNormals tilt_draws = two_normals(counter, 1, draws);
        const TwoNormals other_draws = two_normals(counter, 2, draws);
        Pose& pose = out[i].T_world_vehicle;
        pose.translation += Eigen::Vector3d(errors.position_m * position_draws.first,
                                            errors.position_m * position_draws.second,
                                            errors.depth_m * other_draws.first);
        pose.rotation =
            (rotation_from_rpy(0.0, 0.0, errors.heading_rad * other_draws.second) * pose.rotation *
             rotation_from_rpy(errors.tilt_rad * tilt_draws.first,
                               errors.tilt_rad * tilt_draws.second, 0.0))
                .normalized();
    }
    return out;
}

}  // namespace sonarsim
