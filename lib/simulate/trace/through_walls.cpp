#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

namespace {

// Sound is followed through this many walls, four closed bodies, while this share of it is left.
constexpr int max_walls = 8;
constexpr float min_left = 1e-4F;
// Below this |v . n|, half a degree, a plane is seen edge-on.
constexpr float min_facing = 0.01F;
// Gap behind a surface at which the sound continues, as a share of its range.
constexpr float step_behind = 1e-5F;
constexpr float max_parts = 64.0F;  // along a half edge

/// The sound that goes through a part of a sample.
struct RayBundle {
    Eigen::Vector3f direction;
    Eigen::Vector3f half_u, half_v;  ///< half edges across it, at a range of 1 m
    float solid_angle;
    float strength;
    float range_m = 0.0F;  ///< the begin of its next ray
};

/// Adds the bundles of a sample's parts. Each spans about a resolution cell, as pieces of targets
/// do, since what lies behind may end within a sample.
void add_bundles(const Sample& sample, const View& view, std::vector<RayBundle>& bundles) {
    const Arrival middle = arrival_of(sample.position);
    if (!(middle.range_m > 0.0F)) return;
    const auto across = [](const Eigen::Vector3f& edge,
                           const Eigen::Vector3f& along) -> Eigen::Vector3f {
        return edge - along * along.dot(edge);
    };
    const float cell_m = std::max(static_cast<float>(resolved_width_rad(view)) * middle.range_m,
                                  static_cast<float>(view.bin_m()));
    const auto parts_of = [&](const Eigen::Vector3f& half_edge) {
        const float parts = 2.0F * across(half_edge, middle.direction).norm() / cell_m;
        return static_cast<int>(std::ceil(std::clamp(parts, 1.0F, max_parts)));
    };
    const int rows = parts_of(sample.edge_u);
    const int columns = parts_of(sample.edge_v);
    const Eigen::Vector3f u = sample.edge_u / static_cast<float>(rows);
    const Eigen::Vector3f v = sample.edge_v / static_cast<float>(columns);
    const float section_m3 = sample.area_m2 * sample.height_m / static_cast<float>(rows * columns);
    for (int i = 0; i < rows; ++i) {
        const Eigen::Vector3f row = sample.position + static_cast<float>(2 * i + 1 - rows) * u;
        for (int j = 0; j < columns; ++j) {
            const auto [r, d] = arrival_of(row + static_cast<float>(2 * j + 1 - columns) * v);
            if (!(r > 0.0F)) continue;
            bundles.push_back({.direction = d,
                               .half_u = across(u, d) / r,
                               .half_v = across(v, d) / r,
                               .solid_angle = section_m3 / (r * r * r),
                               .strength = sample.strength});
        }
    }
}

/// The part of the plane of `hit` that a bundle meets at a range.
Sample met_by(const RayBundle& bundle, const Intersection& hit, float range_m) {
    const float along = bundle.direction.dot(hit.normal);
    const auto onto_plane = [&](const Eigen::Vector3f& half) -> Eigen::Vector3f {
        return range_m * (half - half.dot(hit.normal) / along * bundle.direction);
    };
    return {.position = range_m * bundle.direction,
            .edge_u = onto_plane(bundle.half_u),
            .edge_v = onto_plane(bundle.half_v),
            .normal = hit.normal,
            .height_m = range_m * -along,
            .area_m2 = bundle.solid_angle * range_m * range_m / -along,
            .material = hit.material,
            .instance = hit.instance,
            .strength = bundle.strength,
            .kind = SampleKind::behind_wall};
}

}  // namespace

void add_behind_walls(std::span<const float> transmissions, const TraceContext& context,
                      Samples& samples) {
    if (transmissions.empty()) return;
    std::vector<RayBundle> bundles;
    for (const Sample& sample : samples.items) {
        if (transmissions[sample.material] >= min_left) add_bundles(sample, context.view, bundles);
    }
    const auto reach = static_cast<float>(context.view.range_max_m);
    std::vector<Ray> rays;
    std::vector<Intersection> hits;
    // The first rays start at the sonar and find the walls again: a piece of a target may lie off
    // its triangle.
    for (int walls = 0; walls <= max_walls && !bundles.empty(); ++walls) {
        rays.clear();
        for (const RayBundle& bundle : bundles)
            rays.push_back({bundle.range_m * bundle.direction, bundle.direction});
        hits.resize(rays.size());
        context.engine.intersect_behind(context.T_world_sensor, rays, reach, hits);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < rays.size(); ++k) {
            RayBundle& bundle = bundles[k];
            const Intersection& hit = hits[k];
            const float range = bundle.range_m + hit.distance_m;
            if (!(range < reach)) continue;
            const float cosine = -hit.normal.dot(bundle.direction);
            if (walls > 0 && cosine >= min_facing)
                samples.items.push_back(met_by(bundle, hit, range));
            bundle.strength *= transmissions[hit.material];
            if (!(bundle.strength >= min_left)) continue;
            bundle.range_m =
                range * (1.0F + step_behind) + 2.0F * hit.rounding_m / std::max(cosine, min_facing);
            bundles[kept++] = bundle;
        }
        bundles.resize(kept);
    }
}

}  // namespace sonarsim
