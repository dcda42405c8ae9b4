#include "trace/way.h"

#include <cmath>
#include <limits>

#include "trace/bounce_tracer.h"

namespace sonarsim {

void reflect(const WayHit& at, Way& way) {
    const Eigen::Vector3f point = way.ray.origin + at.distance_m * way.ray.direction;
    if (way.reflections < Way::most_kept)
        way.reflectors[way.reflections] = {point, at.normal, at.surface.material == no_material};
    ++way.reflections;
    // The next ray starts above the rounding of the surface.
    const float lift = 1e-4F * (way.length_m + at.distance_m);
    way.ray.origin = point + lift * at.normal;
    way.ray.direction = specular_direction(way.ray.direction, at.normal);
    way.length_m += at.distance_m;
    way.reflected *= at.reflection;
    way.unfold -= 2.0F * (way.unfold * at.normal) * at.normal.transpose();
}

std::vector<Intersection> cast_ways(const TraceContext& trace, std::span<const Way> ways,
                                    MultipathCounts& counts) {
    std::vector<Ray> rays;
    for (const Way& way : ways)
        rays.push_back(way.ray);
    std::vector<Intersection> hits(rays.size());
    trace.engine.intersect(trace.T_world_sensor, rays, hits);
    counts.rays += rays.size();
    return hits;
}

WayHit hit_of_way(const TraceContext& trace, const std::optional<WaterMirror>& water,
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

}  // namespace sonarsim
