#include "simulate/trace/visible_surface.h"

#include <iterator>
#include <utility>

#include "core/elementary.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The guard beams on one side of the view, if they are wider than its beams.
View guard_view(const View& view) {
    View side = view;
    side.guards = {};
    side.beams = view.guards.count;
    side.azimuth_rad = view.guards.count * view.guards.beam_rad;
    return side;
}

/// The pose of that view in the sensor's frame; `side` is -1 for starboard, 1 for port.
Pose guard_side(const View& view, double side) {
    const double middle = 0.5 * (view.azimuth_rad + view.guards.count * view.guards.beam_rad);
    return {rotation_from_rpy(0.0, 0.0, side * middle), Eigen::Vector3d::Zero()};
}

// The error goal from which on beams are joined.
constexpr double joining_goal = 0.02;

int joined_beams(const View& view) {
    return view.relative_l1 >= joining_goal ? view.guards.joined : 1;
}

/// The offsets of a view's beams, from the offsets of its joined beams.
std::vector<std::uint32_t> repeat_offsets(std::span<const std::uint32_t> begins, int joined) {
    std::vector<std::uint32_t> out{begins.front()};
    for (const std::uint32_t end : begins.subspan(1))
        out.insert(out.end(), joined, end);
    return out;
}

/// Adds the surface that the engine sees in the guard beams on one side of the view.
void add_guard_side(const View& view, const Samples& visible, const Pose& T_sensor_side,
                    Samples& out) {
    const Eigen::Matrix3f R = T_sensor_side.rotation.toRotationMatrix().cast<float>();
    for (Sample sample : visible.items) {
        sample.position = R * sample.position;
        if (!in_array_cones(view, sample.position)) continue;
        sample.edge_u = R * sample.edge_u;
        sample.edge_v = R * sample.edge_v;
        sample.normal = R * sample.normal;
        out.items.push_back(sample);
    }
    out.dropped += visible.dropped;
}

}  // namespace

View widened_view(const View& view) {
    View wider = view;
    wider.guards = {};
    wider.beams += 2 * view.guards.count;
    if (view.guards.beam_rad > 0.0)
        wider.azimuth_rad += 2 * view.guards.count * view.guards.beam_rad;
    else
        wider.azimuth_rad *= static_cast<double>(wider.beams) / view.beams;
    return wider;
}

View traced_view(const View& view) {
    View out = widened_view(view);
    out.beams /= joined_beams(view);
    return out;
}

bool in_array_cones(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * arrival_range(position);
}

bool GuardedField::contains(const Eigen::Vector3f& point) const {
    return !(field_.beam(point, arrival_range(point)) < 0.0F) &&
           (view_.guards.count == 0 || in_array_cones(view_, point));
}

std::vector<Sight> sights(const View& view, const Pose& T_world_sensor) {
    if (!(view.guards.beam_rad > 0.0)) return {{traced_view(view), T_world_sensor}};
    View own = view;
    own.guards = {.joined = view.guards.joined};
    std::vector<Sight> all{{traced_view(own), T_world_sensor}};
    for (const double side : {-1.0, 1.0})
        all.push_back({guard_view(view), T_world_sensor * guard_side(view, side)});
    return all;
}

Samples visible_surface(const View& view, const VisibilityEngine& engine,
                        const Pose& T_world_sensor) {
    const std::vector<Sight> views = sights(view, T_world_sensor);
    const auto see = [&](const Sight& sight) {
        return engine.visible_surface(sight.view, sight.T_world_sensor);
    };
    Samples out = see(views[0]);
    std::vector<std::uint32_t>& begins = out.beam_begin;
    begins = repeat_offsets(begins, joined_beams(view));
    if (views.size() > 1) {
        add_guard_side(view, see(views[1]), guard_side(view, -1.0), out);
        add_guard_side(view, see(views[2]), guard_side(view, 1.0), out);
        return out;
    }
    const int guards = view.guards.count;
    if (guards == 0) return out;
    const auto first = out.items.begin() + begins[guards];
    const auto last = out.items.begin() + begins[guards + view.beams];
    const auto is_in_reach = [&](const Sample& sample) {
        return in_array_cones(view, sample.position);
    };
    std::vector<Sample> items(first, last);
    std::copy_if(out.items.begin(), first, std::back_inserter(items), is_in_reach);
    std::copy_if(last, out.items.end(), std::back_inserter(items), is_in_reach);
    out.items = std::move(items);
    const std::uint32_t skipped = begins[guards];
    begins = std::vector<std::uint32_t>(begins.begin() + guards, begins.end() - guards);
    for (std::uint32_t& begin : begins)
        begin -= skipped;
    return out;
}

}  // namespace sonarsim
