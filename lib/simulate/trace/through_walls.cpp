#include <cstddef>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

namespace {

// Sound is followed through walls while this share of it is left.
constexpr float min_left = 1e-4F;
// Below this |v . n|, half a degree, a plane is seen edge-on.
constexpr float min_facing = 0.01F;
constexpr float max_parts = 64.0F;  // along a half edge

/// The sound that goes through a part of a sample.
struct RayBundle {
    Eigen::Vector3f direction;
    Eigen::Vector3f half_u, half_v;  ///< half edges across it, at a range of 1 m
    float solid_angle;
    float strength;
};

/// Adds the bundles of a sample's parts, a resolution cell each: what lies behind may end within.
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

/// The part of the plane of `hit` that a bundle meets.
Sample met_by(const RayBundle& bundle, const Intersection& hit) {
    const float range_m = hit.distance_m;
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
    // Rays start at the sonar: a piece of a target may lie off its triangle.
    std::vector<Ray> rays;
    rays.reserve(bundles.size());
    for (const RayBundle& bundle : bundles)
        rays.push_back({Eigen::Vector3f::Zero(), bundle.direction});
    const auto follow = [&](std::size_t k, std::span<const Intersection> surfaces) {
        RayBundle& bundle = bundles[k];
        for (const Intersection& met : surfaces) {
            const bool is_wall = &met == surfaces.data();
            if (!is_wall && -met.normal.dot(bundle.direction) >= min_facing)
                samples.items.push_back(met_by(bundle, met));
            bundle.strength *= transmissions[met.material];
            if (!(bundle.strength >= min_left)) return;
        }
    };
    context.engine.pass_surfaces(context.T_world_sensor, rays,
                                 static_cast<float>(context.view.range_max_m), follow);
}

}  // namespace sonarsim
