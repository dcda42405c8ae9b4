#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "trace/ping.h"
#include "trace/water_mirror.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

inline constexpr std::uint32_t no_material = 0xFFFFFFFFU;

/// What a traced ray hit: the second surface h.
struct SecondHit {
    Eigen::Vector3f point;    ///< p_h, sensor frame, m
    Eigen::Vector3f normal;   ///< n_h
    float rounding_m = 0.0F;  ///< as in Intersection
    float reflection = 0.0F;  ///< R_h
    /// What it is of, an index into Scene::materials, and R of the water's surface where the sound
    /// was mirrored by it on the way, else 1. The surface itself is of no material.
    std::uint32_t material = no_material;
    float mirrored = 1.0F;
    bool exists = false;
};

/// What becomes of rays that meet the water's surface.
enum class AtSurface {
    ends,     ///< the surface is what they hit
    mirrors,  ///< they go on, and what they hit is seen in the mirror; no other rays hit anything
};

/// What is needed to follow sound from the samples on.
struct SecondLegs {
    const View& view;
    const Samples& samples;
    std::span<const Material> materials;
    const VisibilityEngine& engine;
    const Pose& T_world_sensor;
    float bin_m;
    BeamLocator field;
    const WaterMirror* mirror;  ///< null: the water has no surface
    AtSurface at_surface = AtSurface::ends;

    bool is_mirrored() const { return mirror && at_surface == AtSurface::mirrors; }
    /// Where the sonar is for the last leg of the sound.
    Eigen::Vector3f sonar() const {
        return is_mirrored() ? mirror->image : Eigen::Vector3f(Eigen::Vector3f::Zero());
    }
    /// The point of the world that a second point stands for.
    Eigen::Vector3f seen(const Eigen::Vector3f& p) const {
        return is_mirrored() ? mirror->fold(p) : p;
    }
    Eigen::Vector3f seen_change(const Eigen::Vector3f& of_p) const {
        return is_mirrored() ? mirror->turn(of_p) : of_p;
    }
};

/// The direction in which a mirror sends on what comes along `direction`: r of Eq. 1.
inline Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
    return direction - 2.0F * normal.dot(direction) * normal;
}

/// Traces the samples and appends what their rays hit to `second_hits`. Far from the scene's
/// origin, or on a large triangle, rounding may put the start of a ray below its surface; such a
/// ray is traced once more from above the rounding.
void trace_second_legs(const SecondLegs& context, std::span<const std::uint32_t> sources,
                       std::vector<SecondHit>& second_hits, MultipathCounts& counts);

}  // namespace sonarsim
