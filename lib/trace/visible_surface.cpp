#include "trace/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/elementary.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

/// Adds the surface that the engine sees in the guard beams on one side of the view. They are wider
/// than the beams of the view, and their middle is `middle_rad` off the boresight.
void add_guard_side(const View& view, const GuardBeams& guard_beams, double middle_rad,
                    const VisibilityEngine& engine, const Pose& T_world_sensor,
                    VisibleSurface& out) {
    View side = view;
    side.beams = guard_beams.count;
    side.azimuth_rad = guard_beams.count * guard_beams.beam_rad;
    const Pose T_sensor_side{rotation_from_rpy(0.0, 0.0, middle_rad), Eigen::Vector3d::Zero()};
    const Eigen::Matrix3f R = T_sensor_side.rotation.toRotationMatrix().cast<float>();
    const Samples seen = engine.visible_surface(side, T_world_sensor * T_sensor_side);
    for (Sample sample : seen.items) {
        sample.position = R * sample.position;
        if (!is_reached(view, sample.position)) continue;
        sample.edge_u = R * sample.edge_u;
        sample.edge_v = R * sample.edge_v;
        sample.normal = R * sample.normal;
        out.outside_sector.push_back(sample);
    }
    out.samples.dropped += seen.dropped;
    // Of NaN and a number, fmax gives the number.
    out.samples.estimated_l1 = std::fmax(out.samples.estimated_l1, seen.estimated_l1);
}

}  // namespace

View widened_view(const View& view, const GuardBeams& guard_beams) {
    View wider = view;
    wider.beams += 2 * guard_beams.count;
    if (guard_beams.beam_rad > 0.0)
        wider.azimuth_rad += 2 * guard_beams.count * guard_beams.beam_rad;
    else
        wider.azimuth_rad *= static_cast<double>(wider.beams) / view.beams;
    return wider;
}

bool is_reached(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * arrival_range(position);
}

VisibleSurface visible_surface(const View& view, const GuardBeams& guard_beams,
                               const VisibilityEngine& engine, const Pose& T_world_sensor) {
    VisibleSurface out;
    if (guard_beams.beam_rad > 0.0) {
        out.samples = engine.visible_surface(view, T_world_sensor);
        const double middle = 0.5 * (view.azimuth_rad + guard_beams.count * guard_beams.beam_rad);
        add_guard_side(view, guard_beams, -middle, engine, T_world_sensor, out);
        add_guard_side(view, guard_beams, middle, engine, T_world_sensor, out);
        return out;
    }
    const int guards = guard_beams.count;
    out.samples = engine.visible_surface(widened_view(view, guard_beams), T_world_sensor);
    if (guards == 0) return out;
    std::vector<Sample>& items = out.samples.items;
    std::vector<std::uint32_t>& begins = out.samples.beam_begin;
    const auto first = items.begin() + begins[guards];
    const auto last = items.begin() + begins[guards + view.beams];
    const auto is_in_reach = [&](const Sample& sample) {
        return is_reached(view, sample.position);
    };
    std::copy_if(items.begin(), first, std::back_inserter(out.outside_sector), is_in_reach);
    std::copy_if(last, items.end(), std::back_inserter(out.outside_sector), is_in_reach);
    const std::uint32_t skipped = begins[guards];
    items = std::vector<Sample>(first, last);
    begins = std::vector<std::uint32_t>(begins.begin() + guards, begins.end() - guards);
    for (std::uint32_t& begin : begins)
        begin -= skipped;
    return out;
}

}  // namespace sonarsim
