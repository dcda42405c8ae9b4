#include "simulate/visibility/engine.h"

#include <algorithm>
#include <limits>

namespace sonarsim {

namespace {

/// Bound of the distance of p = o + d v from the plane of a facet through q, in float with a unit u
/// of 2^-24. `lengths_m` is |q - o| + |o| + d. The error of n . (q - o) is 4 u |q - o|. The term d
/// (n . v), with v rotated into the scene's axes, is off by 9 u d. The rotation of o adds 6 u |o|,
/// and its translation u |o| in scene coordinates. The sum p adds u (2 d + |o|), and the direction
/// from the sonar to p adds 2 u |p|.
float plane_rounding(float lengths_m, const Eigen::Vector3f& local_origin) {
    constexpr float unit = 0x1p-24F;
    return unit * (16.0F * lengths_m + 2.0F * local_origin.norm());
}

/// The surface that a ray meets on a facet at a distance. Start and direction in the local frame.
Intersection meet(const Ray& ray, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                  const Facet& facet, float distance_m, const LocalPose& pose) {
    const float lengths_m =
        (facet.vertex - origin).norm() + ray.origin.norm() + std::fabs(distance_m);
    const bool is_behind = facet.normal.dot(direction) > 0.0F;
    const Eigen::Vector3f normal =
        pose.rotation.transpose() * (is_behind ? -facet.normal : facet.normal);
    return {distance_m, plane_rounding(lengths_m, origin), normal, facet.material, facet.instance};
}

/// Rays in the local frame.
struct LocalRays {
    std::vector<Eigen::Vector3f> origins, directions;

    LocalRays(std::span<const Ray> rays, const LocalPose& pose) {
        origins.reserve(rays.size());
        directions.reserve(rays.size());
        for (const Ray& ray : rays) {
            origins.emplace_back(pose.rotation * ray.origin + pose.position);
            directions.emplace_back(pose.rotation * ray.direction);
        }
    }
};

}  // namespace

void VisibilityEngine::intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                                 std::span<Intersection> intersections) const {
    const LocalPose pose = local_pose(T_world_sensor, scene_.origin);
    const LocalRays local(rays, pose);
    std::vector<std::uint32_t> facets(rays.size());
    caster_.cast(local.origins, local.directions, facets);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (facets[i] == Caster::nothing) {
            intersections[i] = {std::numeric_limits<float>::infinity(), 0.0F,
                                Eigen::Vector3f::Zero(), 0, 0};
            continue;
        }
        const Facet facet = caster_.facet(facets[i]);
        const float distance_m = facet.normal.dot(facet.vertex - local.origins[i]) /
                                 facet.normal.dot(local.directions[i]);
        intersections[i] =
            meet(rays[i], local.origins[i], local.directions[i], facet, distance_m, pose);
    }
}

void VisibilityEngine::pass_surfaces(const Pose& T_world_sensor, std::span<const Ray> rays,
                                     float reach_m, const UseSurfaces& use) const {
    constexpr std::size_t batch = 1024;  // a ray may pass thousands of surfaces
    constexpr std::size_t max_surfaces = 64;
    constexpr float same_place = 1e-5F;  // as a share of the range
    const LocalPose pose = local_pose(T_world_sensor, scene_.origin);
    std::vector<float> lengths;
    std::vector<Intersection> surfaces;
    for (std::size_t first = 0; first < rays.size(); first += batch) {
        const std::span<const Ray> some = rays.subspan(first, std::min(batch, rays.size() - first));
        const LocalRays local(some, pose);
        lengths.clear();
        for (const Ray& ray : some)
            lengths.push_back(reach_m - ray.origin.norm());
        const std::vector<MetFacet> met =
            caster_.cast_through(local.origins, local.directions, lengths);
        auto next = met.begin();
        for (std::size_t i = 0; i < some.size(); ++i) {
            surfaces.clear();
            float behind_m = 0.0F;
            std::uint32_t last = 0;  // the lowest number of facets that coincide counts
            for (; next != met.end() && next->ray == i; ++next) {
                if (surfaces.size() == max_surfaces) continue;
                const Intersection found = meet(some[i], local.origins[i], local.directions[i],
                                                caster_.facet(next->facet), next->distance_m, pose);
                const float range_m = some[i].origin.norm() + found.distance_m;
                if (range_m < behind_m) {
                    if (next->facet < last && surfaces.back().coincides(found)) {
                        surfaces.back() = found;
                        last = next->facet;
                    }
                    continue;
                }
                behind_m = range_m * (1.0F + same_place);
                last = next->facet;
                surfaces.push_back(found);
            }
            use(first + i, surfaces);
        }
    }
}

std::vector<bool> VisibilityEngine::visible(const Pose& T_world_sensor,
                                            std::span<const SightPoint> points) const {
    constexpr float min_cosine = 1e-3F;
    const LocalPose pose = local_pose(T_world_sensor, scene_.origin);
    std::vector<Eigen::Vector3f> directions;
    std::vector<float> reach_m;
    for (const SightPoint& point : points) {
        const float range = point.position.norm();
        const float slack = point.slack_m + plane_rounding(2.0F * range, pose.position);
        directions.emplace_back(pose.rotation * (point.position / range));
        reach_m.push_back(range - slack / std::max(point.cosine, min_cosine));
    }
    std::vector<std::uint32_t> facets(points.size());
    caster_.cast_any(pose.position, directions, reach_m, facets);
    std::vector<bool> out(facets.size());
    std::transform(facets.begin(), facets.end(), out.begin(),
                   [](std::uint32_t facet) { return facet == Caster::nothing; });
    return out;
}

}  // namespace sonarsim
