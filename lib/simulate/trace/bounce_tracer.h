#pragma once

#include "input/scene/scene.h"
#include "simulate/trace/bounce_path.h"
#include "simulate/trace/counters.h"
#include "simulate/trace/visible_water_surface.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The hit of a traced ray on the second surface h.
struct BounceHit : SecondPoint {
    float rounding_m = 0.0F;  ///< as in Intersection
    float reflection = 0.0F;  ///< R_h times `strength`
    bool exists = false;
};

/// The role of the water's surface for rays that meet it.
enum class SurfaceRole {
    target,     ///< the rays hit the water's surface
    reflector,  ///< the water's surface reflects the rays; rays that miss it hit nothing
};

/// Follows sound that the samples reflect.
struct BounceTracer {
    const View& view;
    const Samples& samples;
    std::span<const Material> materials;
    const GroundMaps* maps;  ///< null: none
    const VisibilityEngine& engine;
    const Pose& T_world_sensor;
    float bin_m;
    BeamLocator field;
    const WaterMirror* mirror;  ///< null: the water has no surface
    bool scattered = false;     ///< as in Multipath
    SurfaceRole surface_role = SurfaceRole::target;

    bool uses_surface_image() const { return mirror && surface_role == SurfaceRole::reflector; }
    /// The sonar, or its image, as the end of the last leg of the sound.
    Eigen::Vector3f sonar() const {
        return uses_surface_image() ? mirror->image : Eigen::Vector3f(Eigen::Vector3f::Zero());
    }
    /// The true place of a second point, which may be an image in the water's surface.
    Eigen::Vector3f true_point(const Eigen::Vector3f& p) const {
        return uses_surface_image() ? mirror->reflect_point(p) : p;
    }
    Eigen::Vector3f true_change(const Eigen::Vector3f& change) const {
        return uses_surface_image() ? mirror->reflect_direction(change) : change;
    }
};

/// The specular reflection of `direction`: r of Eq. 1.
inline Eigen::Vector3f specular_direction(const Eigen::Vector3f& direction,
                                          const Eigen::Vector3f& normal) {
    return direction - 2.0F * normal.dot(direction) * normal;
}

/// Traces the samples and appends the hits of their rays to `second_hits`. Far from the scene's
/// origin, or on a large triangle, rounding may put the start of a ray below its surface; such a
/// ray is traced once more from above the rounding.
void trace_bounces(const BounceTracer& context, std::span<const std::uint32_t> sources,
                   std::vector<BounceHit>& second_hits, MultipathCounts& counts);

}  // namespace sonarsim
