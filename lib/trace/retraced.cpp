#include "trace/retraced.h"

#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "trace/arrivals.h"
#include "trace/bounce_tracer.h"
#include "trace/lay_maps.h"
#include "trace/water_mirror.h"

namespace sonarsim {

namespace {

// Below this cosine surface is seen edge-on, as in find_bounces().
constexpr float least_seen_cosine = 0.01F;

/// Sound on its way.
struct Way {
    std::uint32_t source;
    Ray ray;                 ///< after the last reflection
    float length_m;          ///< up to it
    float reflected;         ///< share of the power after the reflections so far
    Eigen::Matrix3f unfold;  ///< directions of the scene to those of the world folded out
};

/// A surface that a way meets.
struct Meeting {
    float distance_m;
    Eigen::Vector3f normal;
    float reflection;
    MappedPoint surface{no_material, 1.0F};  ///< no_material: the water's, or the source
};

Eigen::Matrix3f reflection_at(const Eigen::Vector3f& normal) {
    return Eigen::Matrix3f::Identity() - 2.0F * normal * normal.transpose();
}

/// Goes on behind a reflection.
void reflect(const Meeting& at, Way& way) {
    // The next ray starts above the rounding of the surface.
    const float lift = 1e-4F * (way.length_m + at.distance_m);
    way.ray.origin += at.distance_m * way.ray.direction + lift * at.normal;
    way.ray.direction = specular_direction(way.ray.direction, at.normal);
    way.length_m += at.distance_m;
    way.reflected *= at.reflection;
    way.unfold = way.unfold * reflection_at(at.normal);
}

/// The surface that a way meets as the sonar sees it: all sound that met the source goes on to it.
/// When the place on the source moves along an edge, that behind it stays in its plane.
bool unfold(const Sample& source, const Way& way, const Meeting& at, Sample& out) {
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

/// The surface that a way meets where its ray has this hit.
Meeting meeting_at(const TraceContext& trace, const std::optional<WaterMirror>& water,
                   const Ray& ray, const Intersection& hit) {
    const float to_water = water ? water->distance(ray) : std::numeric_limits<float>::infinity();
    if (to_water < hit.distance_m) return {to_water, -water->up, water->reflection};
    if (std::isinf(hit.distance_m)) return {hit.distance_m, -ray.direction, 0.0F};
    MappedPoint surface{hit.material, 1.0F};
    const GroundMaps* const maps = trace.scene.maps.get();
    if (maps && maps->lie_on(hit.instance)) {
        const Eigen::Vector3f point = ray.origin + hit.distance_m * ray.direction;
        surface = mapped_point(*maps, trace.T_world_sensor, point, hit.instance, hit.material);
    }
    const float reflection = trace.scene.materials[surface.material].reflection;
    return {hit.distance_m, hit.normal, reflection * surface.strength, surface};
}

/// Ways from all samples, behind their first reflection.
std::vector<Way> first_ways(const Multipath& multipath, const TraceContext& trace,
                            const Samples& samples) {
    std::vector<Way> ways;
    for (std::uint32_t k = 0; k < samples.items.size(); ++k) {
        const Sample& sample = samples.items[k];
        const Arrival arrival = arrival_of(sample.position);
        if (!(arrival.range_m < static_cast<float>(trace.view.range_max_m))) continue;
        Way way{.source = k,
                .ray = {Eigen::Vector3f::Zero(), arrival.departure},
                .length_m = 0.0F,
                .reflected = 1.0F,
                .unfold = Eigen::Matrix3f::Identity()};
        reflect({arrival.range_m, sample.normal,
                 trace.scene.materials[sample.material].reflection * sample.strength},
                way);
        if (way.reflected * way.reflected >= multipath.retraced_least) ways.push_back(way);
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
    const auto range_max = static_cast<float>(trace.view.range_max_m);
    std::vector<Way> ways = first_ways(multipath, trace, samples);
    std::vector<Ray> rays;
    std::vector<Intersection> hits;
    for (int k = 1; k <= multipath.retraced && !ways.empty(); ++k) {
        rays.clear();
        for (const Way& way : ways)
            rays.push_back(way.ray);
        hits.resize(rays.size());
        trace.engine.intersect(trace.T_world_sensor, rays, hits);
        counts.rays += rays.size();
        std::vector<Way> further;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            Way& way = ways[i];
            const Meeting at = meeting_at(trace, water, rays[i], hits[i]);
            if (!(way.length_m + at.distance_m < range_max)) continue;
            const Sample& source = samples.items[way.source];
            Sample seen = source;
            if (at.surface.material != no_material && unfold(source, way, at, seen)) {
                seen.material = at.surface.material;
                seen.instance = hits[i].instance;
                seen.strength = way.reflected * way.reflected * at.surface.strength;
                out.samples.push_back(seen);
                out.sources.push_back(way.source);
            }
            reflect(at, way);
            if (way.reflected * way.reflected >= multipath.retraced_least) further.push_back(way);
        }
        ways = std::move(further);
    }
    return out;
}

}  // namespace sonarsim
