#include "trace/target_surface.h"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/elementary.h"
#include "trace/apply_target_maps.h"
#include "trace/arrivals.h"
#include "visibility/view_volume.h"

namespace sonarsim {

namespace {

// Resolution cells below which an object or its highlight is a target: an engine is right to 1 dB.
constexpr float max_cells = 4.0F;
// Parts of the view of one or two beams: each is half a beamwidth or less in the presets.
constexpr double min_parts = 32.0;
// The sonar is outside of the ball around a target.
constexpr float min_distance_by_radius = 1.05F;
// Size of the parts that one ray decides on, as a share of a target's diameter: within 0.5 dB.
constexpr float part_by_diameter = 1.0F / 8.0F;
// All but exp(-3^2 / 2), a hundredth, of the power of a highlight lies within this many slopes.
constexpr float highlight_reach = 3.0F;
// Size of a highlight's parts relative to the highlight's own, curvature radius times slope.
constexpr float part_by_highlight = 1.5F;
// Parts are no smaller than this share of a resolution cell.
constexpr float min_part_by_cell = 0.25F;

/// The width in which a view resolves directions, or an engine samples them, rad.
double resolved_width(const View& view) {
    const double parts = std::max<double>(min_parts, view.beams);
    if (view.shape == ViewShape::fan) return view.azimuth_rad / parts;
    return view.elevation_rad / min_parts;
}

/// A target in the sensor frame.
struct Target {
    const PlacedTarget* placed;
    const TargetShape* shape;
    Eigen::Affine3f T_sensor_shape;
    float scale;
    float cell_m;  ///< size of a resolution cell there
    float part_m;  ///< size of the parts whose visibility is found by one ray
    bool inside;   ///< it lies in the view with all of its parts
};

class TargetSampler {
  public:
    TargetSampler(const View& view, const GuardBeams& guard_beams)
        : view_(view),
          field_(view, guard_beams),
          volume_(widened_view(view, guard_beams), Pose{}) {}

    /// The object as a target of this view; nothing if it lies outside or is large enough for an
    /// engine's samples.
    std::optional<Target> target(const TargetShape& shape, const PlacedTarget& placed,
                                 const Eigen::Affine3f& T_sensor_shape) const {
        const float scale = T_sensor_shape.linear().col(0).norm();
        const Eigen::Vector3f centre = T_sensor_shape * shape.centre;
        const float radius = scale * shape.radius_m;
        const float range = arrival_range(centre);
        if (range < min_distance_by_radius * radius) return std::nullopt;
        const Containment contained =
            volume_.of_sensor_frame(centre, radius + volume_.rounding_m());
        if (contained == Containment::outside) return std::nullopt;
        // The cones of a fan's beams do not fill the guard beams, nor does a cone its volume.
        const bool inside = contained == Containment::inside && !field_.is_guarded() &&
                            view_.shape != ViewShape::cone;
        const float cell = std::max(static_cast<float>(resolved_width(view_)) * range,
                                    static_cast<float>(view_.bin_m()));
        const float highlight =
            shape.curvature_m > 0.0F ? scale * shape.curvature_m * placed.min_slope : radius;
        // On a coarse mesh an engine sees facets where the surface is curved.
        const bool is_smooth = shape.turn <= placed.min_slope;
        if (highlight > max_cells * cell && is_smooth) return std::nullopt;
        const float part = part_by_diameter * 2.0F * radius;
        return Target{&placed, &shape, T_sensor_shape, scale, cell, part, inside};
    }

    void add(const Target& target) {
        const TargetShape& shape = *target.shape;
        vertices_.clear();
        for (const Eigen::Vector3f& p : shape.vertices)
            vertices_.push_back(target.T_sensor_shape * p);
        const Eigen::Matrix3f R = target.T_sensor_shape.linear() / target.scale;
        last_point_.reset();
        parts_.reserve(parts_.size() + 2 * shape.triangles.size());
        for (const TargetTriangle& triangle : shape.triangles) {
            Eigen::Vector3f normal = R * triangle.normal;
            const float height = -normal.dot(vertices_[triangle.corners[0]]);
            if (shape.closed && !(height > 0.0F)) continue;
            const float side = height < 0.0F ? -1.0F : 1.0F;
            TargetFacet facet{.corners = {},
                              .normals = {},
                              .normal = side * normal,
                              .curvature_m = side * target.scale * triangle.curvature_m,
                              .material = triangle.material,
                              .instance = target.placed->instance,
                              .region = triangle.region};
            for (int k = 0; k < 3; ++k) {
                facet.corners[k] = vertices_[triangle.corners[k]];
                facet.normals[k] = side * (R * triangle.normals[k]);
            }
            add_parts(facet, target);
        }
    }

    /// The parts that are seen.
    std::vector<TargetFacet> take_seen(const VisibilityEngine& engine, const Pose& T_world_sensor) {
        std::vector<Intersection> hits(rays_.size());
        engine.intersect(T_world_sensor, rays_, hits);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const std::uint32_t ray = ray_of_[k];
            if (!ray_arrives(aims_[ray], hits[ray])) continue;
            if (kept != k) parts_[kept] = parts_[k];
            ++kept;
        }
        parts_.resize(kept);
        return std::move(parts_);
    }

  private:
    /// The part that a ray should reach.
    struct Aim {
        float range_m;
        float cosine;   ///< cosine of the angle between the ray and the normal
        float slack_m;  ///< greatest distance of the part from the surface
    };

    static bool ray_arrives(const Aim& aim, const Intersection& hit) {
        // The ray hit nothing: it passed the outline of the target, where vertices were moved to
        // join them.
        if (!std::isfinite(hit.distance_m)) return true;
        const float slack = (hit.rounding_m + aim.slack_m) / std::max(aim.cosine, 1e-3F);
        return hit.distance_m + slack >= aim.range_m;
    }

    /// Cuts a facet into parts. Where a highlight may lie, the normal turns by about a slope over
    /// each part.
    void add_parts(const TargetFacet& facet, const Target& target) {
        const Eigen::Vector3f u = facet.corners[1] - facet.corners[0];
        const Eigen::Vector3f v = facet.corners[2] - facet.corners[0];
        const float slope = target.placed->min_slope;
        std::optional<FacetTurn> turn;
        if (facet.curvature_m != 0.0F) turn.emplace(facet);
        const bool may_highlight = turn && turn->least <= highlight_reach * slope;
        const float radius = std::fabs(facet.curvature_m);
        const float min_m = min_part_by_cell * target.cell_m;
        const float highlight_m =
            std::clamp(part_by_highlight * radius * slope, min_m, std::max(target.part_m, min_m));
        const float per_turn = may_highlight ? radius / highlight_m : 0.0F;
        const float alike_m = 0.5F * (may_highlight ? highlight_m : target.part_m);
        const float per_part = 1.0F / target.part_m;
        const auto size = [&](float du, float dv) {
            const float by_part = per_part * (du * u + dv * v).norm();
            if (!may_highlight) return by_part;
            return std::max(by_part, per_turn * (du * turn->along_u + dv * turn->along_v).norm());
        };
        cut_triangle(size, [&](const TrianglePart& cut) {
            const Eigen::Vector3f middle =
                facet.corners[0] + cut.centroid.u * u + cut.centroid.v * v;
            if (!target.inside && !field_.contains(middle)) return;
            find_ray(middle, facet.normal, target, alike_m);
            for_each_triangle(facet, cut, [&](const TargetFacet& part) {
                parts_.push_back(part);
                ray_of_.push_back(static_cast<std::uint32_t>(rays_.size() - 1));
            });
        });
    }

    /// Aims a ray at a part, unless the last one arrives within `near_m` of it.
    void find_ray(const Eigen::Vector3f& middle, const Eigen::Vector3f& normal,
                  const Target& target, float near_m) {
        const bool shares = last_point_ && (middle - *last_point_).norm() < near_m &&
                            normal.dot(last_normal_) > 0.9F;
        if (shares) return;
        const float range = arrival_range(middle);
        const Eigen::Vector3f direction = middle / range;
        rays_.push_back({Eigen::Vector3f::Zero(), direction});
        aims_.push_back({range, std::fabs(normal.dot(direction)),
                         weld_slack * target.scale * target.shape->radius_m});
        last_point_ = middle;
        last_normal_ = normal;
    }

    /// Vertices are moved by up to this share of a target's radius when they are joined.
    static constexpr float weld_slack = 2e-5F;

    const View& view_;
    GuardedField field_;
    ViewVolume volume_;
    std::vector<Eigen::Vector3f> vertices_;
    std::vector<TargetFacet> parts_;
    std::vector<std::uint32_t> ray_of_;
    std::vector<Ray> rays_;
    std::vector<Aim> aims_;
    std::optional<Eigen::Vector3f> last_point_;
    Eigen::Vector3f last_normal_ = Eigen::Vector3f::Zero();
};

Eigen::Affine3f in_sensor_frame(const PlacedTarget& placed, const Scene& scene,
                                std::span<const Pose> T_world_body, const Pose& T_world_sensor) {
    const auto affine = [](const Pose& pose) {
        return Eigen::Affine3d(Eigen::Translation3d(pose.translation) * pose.rotation);
    };
    const Eigen::Affine3d T_world_shape =
        placed.body ? affine(T_world_body[*placed.body])
                    : Eigen::Translation3d(scene.origin) * placed.T_local_shape.cast<double>();
    return (affine(T_world_sensor).inverse(Eigen::Isometry) * T_world_shape).cast<float>();
}

}  // namespace

TargetSurface target_surface(const TargetShapes& shapes, const View& view,
                             const GuardBeams& guard_beams, const Scene& scene,
                             const VisibilityEngine& engine, const Pose& T_world_sensor) {
    TargetSurface out;
    TargetSampler sampler(view, guard_beams);
    const std::span<const Pose> bodies = engine.body_poses();
    for (const PlacedTarget& placed : shapes.placed) {
        if (placed.body && bodies.empty()) continue;  // without a pose it is invisible
        const std::optional<Target> target =
            sampler.target(shapes.shapes[placed.shape], placed,
                           in_sensor_frame(placed, scene, bodies, T_world_sensor));
        if (!target) continue;
        out.instances.push_back(placed.instance);
        sampler.add(*target);
    }
    std::ranges::sort(out.instances);
    if (!out.instances.empty()) out.facets = sampler.take_seen(engine, T_world_sensor);
    if (scene.maps) apply_maps_on_targets(*scene.maps, view, T_world_sensor, out.facets);
    return out;
}

}  // namespace sonarsim
