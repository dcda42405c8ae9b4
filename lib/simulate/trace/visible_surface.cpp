#include "simulate/trace/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/elementary.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The guard beams on one side of the view, if they are wider than its beams.
View guard_view(const View& view, const GuardBeams& guard_beams) {
    View side = view;
    side.beams = guard_beams.count;
    side.azimuth_rad = guard_beams.count * guard_beams.beam_rad;
    return side;
}

/// The pose of that view in the sensor's frame; `side` is -1 for starboard, 1 for port.
Pose guard_side(const View& view, const GuardBeams& guard_beams, double side) {
    const double middle = 0.5 * (view.azimuth_rad + guard_beams.count * guard_beams.beam_rad);
    return {rotation_from_rpy(0.0, 0.0, side * middle), Eigen::Vector3d::Zero()};
}

// The error goal from which on beams are joined.
constexpr double joining_goal = 0.02;

int joined_beams(const View& view, const GuardBeams& guard_beams) {
    return view.relative_l1 >= joining_goal ? guard_beams.joined : 1;
}

/// The offsets of a view's beams, from the offsets of its joined beams.
std::vector<std::uint32_t> repeat_offsets(std::span<const std::uint32_t> begins, int joined) {
    std::vector<std::uint32_t> out{begins.front()};
    for (const std::uint32_t end : begins.subspan(1))
        out.insert(out.end(), joined, end);
    return out;
}

/// Adds the surface that the engine sees in the guard beams on one side of the view.
void add_guard_side(const View& view, const Samples& seen, const Pose& T_sensor_side,
                    VisibleSurface& out) {
    const Eigen::Matrix3f R = T_sensor_side.rotation.toRotationMatrix().cast<float>();
    for (Sample sample : seen.items) {
        sample.position = R * sample.position;
        if (!in_array_cones(view, sample.position)) continue;
        sample.edge_u = R * sample.edge_u;
        sample.edge_v = R * sample.edge_v;
        sample.normal = R * sample.normal;
        out.outside_sector.push_back(sample);
    }
    out.samples.dropped += seen.dropped;
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

View traced_view(const View& view, const GuardBeams& guard_beams) {
    View out = widened_view(view, guard_beams);
    out.beams /= joined_beams(view, guard_beams);
    return out;
}

bool in_array_cones(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * arrival_range(position);
}

bool GuardedField::contains(const Eigen::Vector3f& point) const {
    return !(field_.beam(point, arrival_range(point)) < 0.0F) &&
           (!guarded_ || in_array_cones(view_, point));
}

std::vector<Sight> sights(const View& view, const GuardBeams& guard_beams,
                          const Pose& T_world_sensor) {
    if (!(guard_beams.beam_rad > 0.0)) return {{traced_view(view, guard_beams), T_world_sensor}};
    std::vector<Sight> all{{traced_view(view, {.joined = guard_beams.joined}), T_world_sensor}};
    for (const double side : {-1.0, 1.0})
        all.push_back(
            {guard_view(view, guard_beams), T_world_sensor * guard_side(view, guard_beams, side)});
    return all;
}

VisibleSurface visible_surface(const View& view, const GuardBeams& guard_beams,
                               const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const std::vector<Sight> views = sights(view, guard_beams, T_world_sensor);
    const auto see = [&](const Sight& sight) {
        return engine.visible_surface(sight.view, sight.T_world_sensor);
    };
    VisibleSurface out;
    out.samples = see(views[0]);
    std::vector<std::uint32_t>& begins = out.samples.beam_begin;
    begins = repeat_offsets(begins, joined_beams(view, guard_beams));
    if (views.size() > 1) {
        add_guard_side(view, see(views[1]), guard_side(view, guard_beams, -1.0), out);
        add_guard_side(view, see(views[2]), guard_side(view, guard_beams, 1.0), out);
        return out;
    }
    const int guards = guard_beams.count;
    if (guards == 0) return out;
    std::vector<Sample>& items = out.samples.items;
    const auto first = items.begin() + begins[guards];
    const auto last = items.begin() + begins[guards + view.beams];
    const auto is_in_reach = [&](const Sample& sample) {
        return in_array_cones(view, sample.position);
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
