#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The kinds of samples; simulate/trace/sample_kinds.h has their properties.
enum class SampleKind : std::uint8_t {
    surface,       ///< the scene's, as an engine finds it
    target,        ///< a piece of a small or shiny object, simulate/trace/target_surface.h
    particle,      ///< a point in the water; its area is its cross-section
    behind_wall,   ///< surface that sound reaches through thin walls
    water_surface  ///< the water's, if it scatters
};

/// A patch of visible surface: a flat parallelogram that represents `area_m2` of the scene.
/// Positions and edges are those that a sonar measures: where sound bends (Scene::sound_profile),
/// the range by the time and the direction of arrival give an apparent place, not the true one.
struct Sample {
    Eigen::Vector3f position;  ///< centroid, sensor frame, m; of a wedge not the edges' middle
    Eigen::Vector3f edge_u;    ///< half an edge of the footprint, sensor frame, m
    Eigen::Vector3f edge_v;    ///< half the other edge
    Eigen::Vector3f normal;    ///< unit, facing the sonar; its angle to `position` is the true one
    float height_m;  ///< distance of the sonar from the patch's plane: v . n = height_m / range
    float area_m2;
    std::uint32_t material;  ///< index into Scene::materials
    std::uint32_t instance;  ///< index into Scene::instances
    /// The footprint of a slanted piece is a trapezoid about its centroid, `position`: the lengths
    /// of `edge_v` at the end and start of `edge_u`, their difference over their sum.
    float wedge = 0.0F;
    /// Factor on the power that the material sends back, from a map of the scene
    /// (simulate/trace/apply_maps.h) and from bent sound that converges or spreads.
    float strength = 1.0F;
    /// A target: the number of the smooth surface of its instance, from 1 on. A sample of a source
    /// (simulate/trace/sample_source.h): the number that this gives it.
    std::uint32_t number = 0;
    SampleKind kind = SampleKind::surface;
    bool widens_from_axis = false;  ///< the footprint of a ray in a cone (taper.h)

    /// The middle of the edges, where a wedge is as long as its mean.
    Eigen::Vector3f middle() const { return position - wedge / 3.0F * edge_u; }
};

/// The samples that a sonar insonifies. A footprint extends into the next beam by a tenth at most.
struct Samples {
    /// The visible surface, sorted by beam, then what lies in no beam: visible surface in the guard
    /// beams, and the other kinds of samples, one after the other.
    std::vector<Sample> items;
    std::vector<std::uint32_t> beam_begin;  ///< beams + 1 offsets into `items`
    /// Number of patches in view that were dropped: edge-on to within rounding, or at no distance.
    std::uint64_t dropped = 0;

    std::span<const Sample> beam(int j) const {
        return {items.data() + beam_begin[j], items.data() + beam_begin[j + 1]};
    }
    std::span<const Sample> in_beams() const { return std::span(items).first(beam_end()); }
    std::span<const Sample> in_no_beam() const { return std::span(items).subspan(beam_end()); }

  private:
    std::size_t beam_end() const { return beam_begin.empty() ? items.size() : beam_begin.back(); }
};

struct Ray {
    Eigen::Vector3f origin;     ///< sensor frame, m
    Eigen::Vector3f direction;  ///< unit
};

/// The point where a ray meets the scene.
struct Intersection {
    float distance_m;        ///< along the ray; infinite if the ray meets nothing
    float rounding_m;        ///< largest distance of that point from its surface
    Eigen::Vector3f normal;  ///< unit, facing the ray's origin
    std::uint32_t material;  ///< index into Scene::materials
    std::uint32_t instance;  ///< index into Scene::instances

    /// True if both surfaces are parts of one plane, to within rounding.
    bool coincides(const Intersection& other) const {
        return std::fabs(distance_m - other.distance_m) <= rounding_m + other.rounding_m &&
               normal.cross(other.normal).lpNorm<1>() < 0x1p-18F;
    }
};

/// Takes the number of a ray, and the surfaces that it passes.
using UseSurfaces = std::function<void(std::size_t ray, std::span<const Intersection> surfaces)>;

/// A point that the sonar may see.
struct SightPoint {
    Eigen::Vector3f position;  ///< sensor frame, m
    float cosine = 1.0F;       ///< cosine of the angle of incidence on the surface that it lies on
    float slack_m = 0.0F;      ///< largest distance of the point from that surface
};

/// A view from a pose.
struct Sight {
    View view;
    Pose T_world_sensor;
};

/// Finds the surface of a scene that a sonar insonifies. Engines are immutable to their callers:
/// any number of threads may call them at once, and a result depends only on the arguments.
class VisibilityEngine {
  public:
    virtual ~VisibilityEngine() = default;

    /// The surface in `view` that is visible from `T_world_sensor` within the greatest range.
    /// Surface before the least range hides what is behind; it may be among the samples.
    virtual Samples visible_surface(const View& view, const Pose& T_world_sensor) const = 0;

    /// The first surface that each ray meets. `intersections` has as many elements as `rays`.
    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const;

    /// True for the points that no surface hides from the sonar. Surface that is nearer by no more
    /// than the slack of the point and the rounding of its plane does not hide it.
    virtual std::vector<bool> visible(const Pose& T_world_sensor,
                                      std::span<const SightPoint> points) const;

    /// The surfaces along the paths of sound, which may bend: a ray starts at an apparent place,
    /// leads away from the sonar, and ends within `reach_m` of the sonar. `use` is called for each
    /// ray, in their order, with at most 64 surfaces; 8 where sound bends.
    virtual void pass_surfaces(const Pose& T_world_sensor, std::span<const Ray> rays, float reach_m,
                               const UseSurfaces& use) const;

    /// The engine with Scene::bodies at these poses. It shares everything else with this engine,
    /// and must not outlive it. Without this call bodies are invisible. Call it only for scenes
    /// with bodies; `unsupported` names the engines that cannot trace bodies.
    virtual std::unique_ptr<VisibilityEngine> at(std::span<const Pose> /*T_world_body*/) const {
        throw std::logic_error("this engine does not know of bodies that move");
    }

    /// The engine whose samples multipath starts from: each is a place that a ray meets, and no
    /// larger than the spacing of the rays. It must not outlive this engine.
    virtual const VisibilityEngine& by_rays() const { return *this; }

    /// The poses of Scene::bodies that at() was given; empty without them. World.
    std::span<const Pose> body_poses() const { return caster_.body_poses(); }

  protected:
    /// `scene` must outlive it, and is what `caster` traces.
    VisibilityEngine(const Scene& scene, Caster caster)
        : scene_(scene), caster_(std::move(caster)) {}

    const Scene& scene() const { return scene_; }
    const Caster& caster() const { return caster_; }

  private:
    const Scene& scene_;
    Caster caster_;
};

}  // namespace sonarsim
