#include "simulate/visibility/engine.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

void VisibilityEngine::intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                                 std::span<Intersection> intersections) const {
    const LocalPose pose = local_pose(T_world_sensor, scene_.origin);
    const Intersection none{std::numeric_limits<float>::infinity(), 0.0F, Eigen::Vector3f::Zero(),
                            0, 0};
    // Skips rays that surely meet nothing, like most rays that leave a scene's walls and floor.
    std::vector<std::uint32_t> aimed;
    std::vector<Eigen::Vector3f> origins;
    std::vector<Eigen::Vector3f> directions;
    aimed.reserve(rays.size());
    origins.reserve(rays.size());
    directions.reserve(rays.size());
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        const Eigen::Vector3f origin = pose.rotation * rays[i].origin + pose.position;
        const Eigen::Vector3f direction = pose.rotation * rays[i].direction;
        intersections[i] = none;
        if (!caster_.may_meet(origin, direction)) continue;
        aimed.push_back(i);
        origins.push_back(origin);
        directions.push_back(direction);
    }
    std::vector<std::uint32_t> facets(aimed.size());
    caster_.cast(origins, directions, facets);
    for (std::size_t k = 0; k < aimed.size(); ++k) {
        if (facets[k] == Caster::nothing) continue;
        const std::uint32_t i = aimed[k];
        const Facet facet = caster_.facet(facets[k]);
        const float along = facet.normal.dot(directions[k]);
        const Eigen::Vector3f to_vertex = facet.vertex - origins[k];
        const float distance = facet.normal.dot(to_vertex) / along;
        const float rounding = plane_rounding(
            to_vertex.norm() + rays[i].origin.norm() + std::fabs(distance), origins[k]);
        const Eigen::Vector3f normal =
            pose.rotation.transpose() * (along > 0.0F ? -facet.normal : facet.normal);
        intersections[i] = {distance, rounding, normal, facet.material, facet.instance};
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
