#include "labels/sight_lines.h"

#include <algorithm>
#include <cmath>

#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// Surface that is seen edge-on covers all ranges; its extent is limited to this share of its range.
constexpr float longest_half = 0.1F;

/// Adds the sight line behind a sample.
void add_line(const Sample& sample, int beam, std::vector<SightLine>& lines) {
    if (beam < 0) return;
    const auto [range, departure, direction] = arrival_of(sample.position);
    const auto number = static_cast<std::uint32_t>(lines.size());
    lines.push_back({.direction = departure,
                     .before_m = range,
                     .range_m = range,
                     .solid_angle = sample.area_m2 * sample.height_m / (range * range * range),
                     .sample = &sample,
                     .beam = static_cast<std::uint32_t>(beam),
                     .first = number,
                     .passed = number});
}

/// The change of a plane's range along the half edge of the footprint in front of it.
float range_along(const Eigen::Vector3f& edge, const Eigen::Vector3f& direction, float before_m,
                  const Eigen::Vector3f& normal, float range_m) {
    const Eigen::Vector3f turn = (edge - direction * direction.dot(edge)) / before_m;
    return std::fabs(range_m * normal.dot(turn) / normal.dot(direction));
}

}  // namespace

std::vector<SightLine> sight_lines(const TracedPing& traced, const ConeBeams& cones, int beams) {
    const Samples& samples = traced.samples;
    std::vector<SightLine> lines;
    lines.reserve(samples.items.size() + traced.outside_sector.size());
    const auto beam_of_cones = [&](const Sample& sample) {
        return cones.beam(arrival_of(sample.position).direction.y());
    };
    for (int j = 0; j < beams; ++j) {
        for (const Sample& sample : samples.beam(j))
            add_line(sample, cones.exist() ? beam_of_cones(sample) : j, lines);
    }
    if (!cones.exist()) return lines;
    for (const Sample& sample : traced.outside_sector)
        add_line(sample, beam_of_cones(sample), lines);
    return lines;
}

float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal) {
    const Sample& sample = *line.sample;
    const float half = range_along(sample.edge_u, line.direction, line.before_m, normal, range_m) +
                       range_along(sample.edge_v, line.direction, line.before_m, normal, range_m);
    const float most = longest_half * range_m;
    // The quotient may be NaN for a plane that is seen edge-on.
    return half < most ? half : most;
}

int beams_along(const Eigen::Vector3f& half_edge, const SightLine& line, const ConeBeams& cones) {
    constexpr float most = 64.0F;
    const float across = half_edge.y() - line.direction.y() * line.direction.dot(half_edge);
    const float beams = 2.0F * std::fabs(across) / line.before_m / cones.mean_width();
    return static_cast<int>(std::ceil(std::clamp(beams, 1.0F, most)));
}

}  // namespace sonarsim
