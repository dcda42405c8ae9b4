#include "input/trajectory/pose_changes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t cosines = 64;

struct Cosine {
    double rad_per_s;
    double phase;
};

std::vector<Cosine> draw_cosines(std::uint32_t movement, const MotionConfig& motion,
                                 PhiloxKey draws) {
    std::vector<Cosine> out;
    out.reserve(cosines);
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
        const TwoNormals position_draws = two_normals(philox({counter, 0, 0, 0}, draws));
        const TwoNormals tilt_draws = two_normals(philox({counter, 1, 0, 0}, draws));
        const TwoNormals other_draws = two_normals(philox({counter, 2, 0, 0}, draws));
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
