#include "visibility/view_parts.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

// These are chosen.
constexpr int most_beams = 6;            // a part has
constexpr std::array places{0.25, 0.8};  // for the parts in a fan

}  // namespace

std::vector<Sight> parts_of(const View& view, const Pose& T_world_sensor) {
    if (view.shape != ViewShape::fan || view.beams <= 2 * most_beams)
        return {{view, T_world_sensor}};
    std::vector<Sight> out;
    const double beam_rad = view.azimuth_rad / view.beams;
    for (const double place : places) {
        View part = view;
        part.beams = most_beams;
        part.azimuth_rad = most_beams * beam_rad;
        const double first = std::floor(place * (view.beams - most_beams));
        const double yaw_rad = -0.5 * view.azimuth_rad + (first + 0.5 * most_beams) * beam_rad;
        Pose pose = T_world_sensor;
        const SinCos half = sincos(0.5 * yaw_rad);
        pose.rotation = pose.rotation * Eigen::Quaterniond(half.cos, 0.0, 0.0, half.sin);
        out.push_back({part, pose});
    }
    return out;
}

}  // namespace sonarsim
