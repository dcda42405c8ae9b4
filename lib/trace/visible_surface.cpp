#include "trace/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/elementary.h"
#include "trace/arrivals.h"

namespace sonarsim {

View widened_view(const View& view, int guard_beams) {
    View wider = view;
    wider.beams += 2 * guard_beams;
    wider.azimuth_rad *= static_cast<double>(wider.beams) / view.beams;
    return wider;
}

bool is_reached(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * arrival_range(position);
}

VisibleSurface visible_surface(const View& view, int guard_beams, const VisibilityEngine& engine,
                               const Pose& T_world_sensor) {
    VisibleSurface out;
    out.samples = engine.visible_surface(widened_view(view, guard_beams), T_world_sensor);
    if (guard_beams == 0) return out;
    std::vector<Sample>& items = out.samples.items;
    std::vector<std::uint32_t>& begins = out.samples.beam_begin;
    const auto first = items.begin() + begins[guard_beams];
    const auto last = items.begin() + begins[guard_beams + view.beams];
    const auto is_in_reach = [&](const Sample& sample) {
        return is_reached(view, sample.position);
    };
    std::copy_if(items.begin(), first, std::back_inserter(out.outside_sector), is_in_reach);
    std::copy_if(last, items.end(), std::back_inserter(out.outside_sector), is_in_reach);
    const std::uint32_t skipped = begins[guard_beams];
    items = std::vector<Sample>(first, last);
    begins = std::vector<std::uint32_t>(begins.begin() + guard_beams, begins.end() - guard_beams);
    for (std::uint32_t& begin : begins)
        begin -= skipped;
    return out;
}

}  // namespace sonarsim
