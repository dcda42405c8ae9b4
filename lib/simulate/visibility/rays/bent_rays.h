#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/view.h"
#include "simulate/water/sound_profile.h"

namespace sonarsim {

/// The water that bends rays.
struct BentWater {
    const SoundProfile* profile = nullptr;  ///< null: paths are straight
    double origin_m = 0.0;                  ///< height of the scene's origin in the world
    double sag_m = 0.0;  ///< rays are cast as chords of their arcs, which are off by this at most
};

/// The effect of the water on the surface that a ray met.
struct RayTube {
    Eigen::Vector3f normal;  ///< unit; its angle to the ray at its start is the true one
    float cosine = 0.0F;     ///< cosine of the true angle of incidence
    float area = 1.0F;       ///< true over apparent area
    float strength = 1.0F;   ///< power over that of straight sound at the apparent range
};

/// The surface that a bent ray met, at its apparent place.
struct BentHit {
    std::uint32_t facet = Caster::nothing;
    float range_m = 0.0F;
    Eigen::Vector3f normal;  ///< unit, normal to the apparent plane, facing the sonar, scene-local
    float cosine = 0.0F;     ///< cosine of the angle of incidence on that plane
    RayTube tube;            ///< scene-local
};

/// Casts rays from `position`, scene-local, which meet nothing before `from_m` [rays]; empty: 0.
void cast_bent_rays(const Caster& caster, const BentWater& water, const Eigen::Vector3f& position,
                    std::span<const Eigen::Vector3f> directions, std::span<const float> from_m,
                    float reach_m, std::span<BentHit> hits);

/// VisibilityEngine::pass_surfaces() where sound bends: the first surfaces of each ray.
void pass_bent_rays(const Caster& caster, const BentWater& water, const LocalPose& pose,
                    std::span<const Ray> rays, float reach_m, int max_surfaces,
                    const UseSurfaces& use);

}  // namespace sonarsim
