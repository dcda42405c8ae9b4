#include "trace/retraced.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "trace/arrivals.h"
#include "trace/unequal_ways.h"
#include "trace/water_mirror.h"
#include "trace/way.h"

namespace sonarsim {

namespace {

// At most this many paths are tried at a time, to bound the memory.
constexpr std::size_t most_candidates = 4096;

/// Finds the surface that a way meets, at its apparent place. It receives all sound that met the
/// source: when a point moves along an edge of the source, its image moves in the plane of this
/// surface.
bool unfold(const Sample& source, const Way& way, const WayHit& at, Sample& out) {
    const Arrival arrival = arrival_of(source.position);
    const float range = way.length_m + at.distance_m;
    const Eigen::Vector3f normal = way.unfold * at.normal;
    const float cosine = -normal.dot(arrival.direction);
    if (!(cosine >= least_seen_cosine)) return false;
    const float t = range / arrival.range_m;
    const auto behind = [&](const Eigen::Vector3f& edge) -> Eigen::Vector3f {
        return t * (edge + edge.dot(normal) / (cosine * arrival.range_m) * source.position);
    };
    out.position = t * source.position;
    out.edge_u = behind(source.edge_u);
    out.edge_v = behind(source.edge_v);
    out.normal = normal;
    out.height_m = cosine * range;
    out.area_m2 = source.area_m2 * source.height_m / arrival.range_m * t * t / cosine;
    return true;
}

/// The ways over all samples, after this first reflection.
std::vector<Way> first_ways(const Multipath& multipath, const TraceContext& trace,
                            const Samples& samples) {
    std::vector<Way> ways;
    for (std::uint32_t k = 0; k < samples.items.size(); ++k) {
        const Sample& sample = samples.items[k];
        const Arrival arrival = arrival_of(sample.position);
        if (!(arrival.range_m < static_cast<float>(trace.view.range_max_m))) continue;
        Way way;
        way.source = k;
        way.ray = {Eigen::Vector3f::Zero(), arrival.departure};
        reflect({arrival.range_m, sample.normal,
                 trace.scene.materials[sample.material].reflection * sample.strength},
                way);
        if (way.reflected >= multipath.retraced_least) ways.push_back(way);
    }
    return ways;
}

}  // namespace

RetracedSurface retraced_surface(const Multipath& multipath, const TraceContext& trace,
                                 const Samples& samples, MultipathCounts& counts) {
    RetracedSurface out;
    if (multipath.retraced == 0) return out;
    const std::optional<WaterMirror> water =
        mirror_of(trace.scene.water_surface, trace.T_world_sensor);
    const BeamLocator field(trace.view);
    const auto range_max = static_cast<float>(trace.view.range_max_m);
    std::vector<Way> ways = first_ways(multipath, trace, samples);
    std::vector<CandidatePath> candidates;
    for (int k = 1; k <= multipath.retraced && !ways.empty(); ++k) {
        const std::vector<Intersection> hits = cast_ways(trace, ways, counts);
        std::vector<Way> further;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            Way& way = ways[i];
            const WayHit at = hit_of_way(trace, water, way.ray, hits[i]);
            // Up to twice the range: sound may return over a shorter way.
            const float range = way.length_m + at.distance_m;
            if (!(range < 2.0F * range_max)) continue;
            const Sample& source = samples.items[way.source];
            Sample seen = source;
            if (at.surface.material != no_material && unfold(source, way, at, seen)) {
                seen.material = at.surface.material;
                seen.instance = hits[i].instance;
                add_candidates(trace, field, way, at, seen, candidates);
                const float reflected = way.reflected * way.reflected;
                seen.strength = reflected * at.surface.strength;
                if (range < range_max && reflected >= multipath.retraced_least) {
                    out.samples.push_back(seen);
                    out.sources.push_back(way.source);
                }
            }
            if (candidates.size() >= most_candidates)
                trace_candidates(multipath, trace, water, candidates, out.unequal, counts);
            reflect(at, way);
            if (way.reflected >= multipath.retraced_least) further.push_back(way);
        }
        ways = std::move(further);
    }
    trace_candidates(multipath, trace, water, candidates, out.unequal, counts);
    return out;
}

}  // namespace sonarsim
