#include "ping/heard_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// Adds what the engine sees to one side of the view, `middle_rad` off the boresight, in beams that
/// are wider than those of the view.
void look_aside(const View& view, const BeamsBeside& beside, double middle_rad,
                const VisibilityEngine& engine, const Pose& T_world_sensor, HeardSurface& out) {
    View side = view;
    side.beams = beside.count;
    side.azimuth_rad = beside.count * beside.beam_rad;
    const Pose T_sensor_side{rotation_from_rpy(0.0, 0.0, middle_rad), Eigen::Vector3d::Zero()};
    const Eigen::Matrix3f R = T_sensor_side.rotation.toRotationMatrix().cast<float>();
    const Samples seen = engine.visible_surface(side, T_world_sensor * T_sensor_side);
    for (Sample sample : seen.items) {
        sample.position = R * sample.position;
        if (!is_reached(view, sample.position)) continue;
        sample.edge_u = R * sample.edge_u;
        sample.edge_v = R * sample.edge_v;
        sample.normal = R * sample.normal;
        out.beside.push_back(sample);
    }
    out.samples.dropped += seen.dropped;
    // Of NaN and a number the number.
    out.samples.estimated_l1 = std::fmax(out.samples.estimated_l1, seen.estimated_l1);
}

}  // namespace

View heard_view(const View& view, const BeamsBeside& beside) {
    View wider = view;
    wider.beams += 2 * beside.count;
    if (beside.beam_rad > 0.0)
        wider.azimuth_rad += 2 * beside.count * beside.beam_rad;
    else
        wider.azimuth_rad *= static_cast<double>(wider.beams) / view.beams;
    return wider;
}

bool is_reached(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * position.norm();
}

HeardSurface heard_surface(const View& view, const BeamsBeside& beside,
                           const VisibilityEngine& engine, const Pose& T_world_sensor) {
    HeardSurface out;
    if (beside.beam_rad > 0.0) {
        out.samples = engine.visible_surface(view, T_world_sensor);
        const double middle = 0.5 * (view.azimuth_rad + beside.count * beside.beam_rad);
        look_aside(view, beside, -middle, engine, T_world_sensor, out);
        look_aside(view, beside, middle, engine, T_world_sensor, out);
        return out;
    }
    const int beams_beside = beside.count;
    out.samples = engine.visible_surface(heard_view(view, beside), T_world_sensor);
    if (beams_beside == 0) return out;
    std::vector<Sample>& items = out.samples.items;
    std::vector<std::uint32_t>& begins = out.samples.beam_begin;
    const auto first = items.begin() + begins[beams_beside];
    const auto last = items.begin() + begins[beams_beside + view.beams];
    const auto is_heard = [&](const Sample& sample) { return is_reached(view, sample.position); };
    std::copy_if(items.begin(), first, std::back_inserter(out.beside), is_heard);
    std::copy_if(last, items.end(), std::back_inserter(out.beside), is_heard);
    const std::uint32_t skipped = begins[beams_beside];
    items = std::vector<Sample>(first, last);
    begins = std::vector<std::uint32_t>(begins.begin() + beams_beside, begins.end() - beams_beside);
    for (std::uint32_t& begin : begins)
        begin -= skipped;
    return out;
}

}  // namespace sonarsim
