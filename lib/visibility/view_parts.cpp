#include "visibility/view_parts.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

// Chosen.
constexpr int most_beams = 6;            // number of beams of a part
constexpr std::array places{0.25, 0.8};  // places of the parts, 0 (first beams) to 1 (last)

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
