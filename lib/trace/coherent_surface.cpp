#include "trace/coherent_surface.h"

#include <Eigen/Geometry>
#include <cmath>

#include "trace/arrivals.h"
#include "trace/plates.h"

namespace sonarsim {

namespace {

constexpr int parts_of_edge = 8;
// A ray meets the plate this far from the border, by the length of the part of the edge.
constexpr double inset_by_part = 0.05;
// Surface nearer than the plate by more than this share of the range hides it.
constexpr double hiding_share = 1e-3;

bool is_in_view(const View& view, const Eigen::Vector3d& point) {
    const Eigen::Vector3f p = point.cast<float>();
    return arrival_range(p) <= static_cast<float>(view.range_max_m) && beam_of(view, p) >= 0;
}

/// Finds the parts of a plate that are in view and not hidden.
void find_seen(const VisibilityEngine& engine, const Pose& T_world_sensor, const View& view,
               PlateOfPing& plate) {
    std::vector<Ray> rays;
    std::vector<double> ranges;
    std::vector<bool*> answers;
    const auto ask = [&](const Eigen::Vector3d& point, bool& seen) {
        seen = false;
        const double range = arrival_range(point.cast<float>());
        rays.push_back({Eigen::Vector3f::Zero(), (point / range).cast<float>()});
        ranges.push_back(range);
        answers.push_back(&seen);
    };
    double area = 0.0;  // positive if the border goes round the normal
    for (const PlateEdge& edge : plate.edges)
        area += plate.normal.dot(edge.from.cross(edge.to));
    const Eigen::Vector3d foot = plate.height_m * plate.normal;
    plate.foot_seen = is_in_view(view, foot);
    if (plate.foot_seen) ask(foot, plate.foot_seen);
    for (PlateEdge& edge : plate.edges) {
        const Eigen::Vector3d middle = 0.5 * (edge.from + edge.to);
        edge.seen =
            is_in_view(view, edge.from) || is_in_view(view, middle) || is_in_view(view, edge.to);
        const Eigen::Vector3d inwards = plate.normal.cross(edge.to - edge.from);
        if (edge.seen) ask(middle + std::copysign(inset_by_part, area) * inwards, edge.seen);
    }
    std::vector<Intersection> hits(rays.size());
    engine.intersect(T_world_sensor, rays, hits);
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const double nearest = (1.0 - hiding_share) * ranges[k] - hits[k].rounding_m;
        *answers[k] = hits[k].distance_m >= nearest;
    }
}

}  // namespace

CoherentSurface coherent_surface(const CoherentFaces& faces, const Scene& scene,
                                 const VisibilityEngine& engine, const Pose& T_world_sensor,
                                 const View& view) {
    CoherentSurface out;
    const Eigen::Quaterniond R_sensor_world = T_world_sensor.rotation.conjugate();
    const Eigen::Vector3d sensor = T_world_sensor.translation - scene.origin;
    for (const ScenePlate& plate : faces.plates) {
        const auto seen_at = [&](const Eigen::Vector3f& p) -> Eigen::Vector3d {
            return R_sensor_world * (p.cast<double>() - sensor);
        };
        PlateOfPing at;
        at.normal = R_sensor_world * plate.normal.cast<double>();
        at.height_m = at.normal.dot(seen_at(plate.border.front()[0]));
        if (at.height_m < 0.0) {
            at.normal = -at.normal;
            at.height_m = -at.height_m;
        }
        if (at.height_m > view.range_max_m || !(at.height_m > 0.0)) continue;
        for (const auto& side : plate.border) {
            const Eigen::Vector3d from = seen_at(side[0]);
            const Eigen::Vector3d to = seen_at(side[1]);
            for (int k = 0; k < parts_of_edge; ++k) {
                const auto part = [&](int n) -> Eigen::Vector3d {
                    return from + (to - from) * (static_cast<double>(n) / parts_of_edge);
                };
                at.edges.push_back({part(k), part(k + 1)});
            }
        }
        at.material = plate.material;
        find_seen(engine, T_world_sensor, view, at);
        out.faces.push_back({plate.instance, plate.material, at.normal, at.height_m});
        out.plates.push_back(std::move(at));
    }
    return out;
}

}  // namespace sonarsim
