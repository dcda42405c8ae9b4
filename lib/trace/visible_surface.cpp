#include "trace/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

View heard_view(const View& view, int beams_beside) {
    View wider = view;
    wider.beams += 2 * beams_beside;
    wider.azimuth_rad *= static_cast<double>(wider.beams) / view.beams;
    return wider;
}

bool is_reached(const View& view, const Eigen::Vector3f& position) {
    const auto widest = static_cast<float>(sincos(0.5 * view.azimuth_rad).sin);
    return std::fabs(position.y()) <= widest * position.norm();
}

HeardSurface heard_surface(const View& view, int beams_beside, const VisibilityEngine& engine,
                           const Pose& T_world_sensor) {
    HeardSurface out;
    out.samples = engine.visible_surface(heard_view(view, beams_beside), T_world_sensor);
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
