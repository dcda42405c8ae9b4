#include "simulate/trace/bounce_tracer.h"

#include <limits>

#include "simulate/trace/apply_maps.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The ray that leaves a sample. It starts above the facets, below which a sample may lie.
Ray specular_ray(const Sample& sample, float bin_m) {
    const Arrival arrival = arrival_of(sample.position);
    const float size = sample.edge_u.norm() + sample.edge_v.norm();
    const float lift = 1e-4F * arrival.range_m + std::min(0.05F * size, 0.5F * bin_m);
    return {sample.position + lift * sample.normal,
            specular_direction(arrival.direction, sample.normal)};
}

/// True if a ray may have hit the surface that it started from: its start lies in that plane.
bool hit_its_start(const Ray& ray, const Intersection& hit) {
    return std::fabs(hit.distance_m * hit.normal.dot(ray.direction)) <= hit.rounding_m;
}

/// Sets material, strength and reflection at a hit. `point` is its true place, not its image.
void set_surface(const BounceTracer& context, const Intersection& hit, const Eigen::Vector3f& point,
                 BounceHit& out) {
    MappedPoint surface{hit.material, 1.0F};
    if (context.maps && context.maps->lie_on(hit.instance))
        surface =
            mapped_point(*context.maps, context.T_world_sensor, point, hit.instance, hit.material);
    out.material = surface.material;
    out.instance = hit.instance;
    out.strength = surface.strength;
    out.reflection = context.materials[surface.material].reflection * surface.strength;
}

/// Reflects the rays that meet the water's surface first (`hits`); appends the images of points.
void trace_surface_reflection(const BounceTracer& context, std::span<const Ray> rays,
                              std::span<const Intersection> hits,
                              std::vector<BounceHit>& second_hits, MultipathCounts& counts) {
    const WaterMirror& mirror = *context.mirror;
    std::vector<Ray> specular_rays;
    std::vector<std::size_t> second_of;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        second_hits.emplace_back();
        const float distance = mirror.distance(rays[k]);
        if (!(distance < hits[k].distance_m)) continue;
        second_of.push_back(second_hits.size() - 1);
        specular_rays.push_back({rays[k].origin + distance * rays[k].direction,
                                 mirror.reflect_direction(rays[k].direction)});
    }
    std::vector<Intersection> behind(specular_rays.size());
    context.engine.intersect(context.T_world_sensor, specular_rays, behind);
    counts.rays += specular_rays.size();
    for (std::size_t k = 0; k < behind.size(); ++k) {
        if (!std::isfinite(behind[k].distance_m)) continue;
        const Ray& ray = specular_rays[k];
        const Eigen::Vector3f point = ray.origin + behind[k].distance_m * ray.direction;
        BounceHit& second = second_hits[second_of[k]];
        second.point = mirror.reflect_point(point);
        second.normal = mirror.reflect_direction(behind[k].normal);
        second.rounding_m = behind[k].rounding_m;
        second.water_reflection = mirror.reflection;
        second.exists = true;
        set_surface(context, behind[k], point, second);
        second.reflection *= mirror.reflection;
    }
}

}  // namespace

void trace_bounces(const BounceTracer& context, std::span<const std::uint32_t> sources,
                   std::vector<BounceHit>& second_hits, MultipathCounts& counts) {
    std::vector<Ray> rays;
    rays.reserve(sources.size());
    for (const std::uint32_t i : sources)
        rays.push_back(specular_ray(context.samples.items[i], context.bin_m));
    std::vector<Intersection> hits(rays.size());
    context.engine.intersect(context.T_world_sensor, rays, hits);
    counts.rays += rays.size();
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (!hit_its_start(rays[k], hits[k])) continue;
        rays[k].origin += 2.0F * hits[k].rounding_m * context.samples.items[sources[k]].normal;
        context.engine.intersect(context.T_world_sensor, {&rays[k], 1}, {&hits[k], 1});
        ++counts.rays;
    }
    if (context.uses_surface_image()) {
        trace_surface_reflection(context, rays, hits, second_hits, counts);
        return;
    }
    for (std::size_t k = 0; k < rays.size(); ++k) {
        BounceHit& second = second_hits.emplace_back();
        const float at_surface = context.mirror ? context.mirror->distance(rays[k])
                                                : std::numeric_limits<float>::infinity();
        const bool meets_water = at_surface < hits[k].distance_m;
        const float distance = meets_water ? at_surface : hits[k].distance_m;
        if (!std::isfinite(distance)) continue;
        second.point = rays[k].origin + distance * rays[k].direction;
        second.rounding_m = hits[k].rounding_m;
        second.exists = true;
        if (meets_water) {
            second.normal = -context.mirror->up;
            second.reflection = context.mirror->reflection;
        } else {
            second.normal = hits[k].normal;
            set_surface(context, hits[k], second.point, second);
        }
    }
}

}  // namespace sonarsim
