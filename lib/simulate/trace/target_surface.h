#pragma once

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/trace/target_shapes.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/engine.h"

// The highlight of a smooth curved surface. With incidence angles t off the normal and facets of
// RMS slope s, a sphere of radius a sends back
//
//     integral of R / (8 pi s^2 cos^4 t) exp(-tan^2 t / (2 s^2)) dA,   dA = 2 pi a^2 sin t dt.
//
// With u = tan t it is R a^2 / (4 s^2) times the integral of u sqrt(1 + u^2) exp(-u^2 / (2 s^2))
// du, that is R a^2 / 4 (1 + s^2 + ...): the target strength 20 log(a / 2) + 10 log R for any small
// slope. The highlight has the size a s. A surface with two radii of curvature gives R a b / 4: the
// echo depends on the area over which the normal turns by an angle.
//
// A mesh of flat triangles with interpolated normals n = sum w_i n_i has this area if the areas of
// its pieces are corrected. On a sphere the corners' normals point along the corners, so n / |n|
// points along the piece's place p in the triangle, |p| = a |n|. Seen from the centre, the piece dA
// of the triangle, whose normal is N, covers the solid angle (N . n / |n|) dA / |p|^2, which on the
// sphere has the area
//
//     dA (N . n / |n|) / |n|^2,   at the place p + a (1 - |n|) n / |n|.
//
// On a cylinder of k sides this is too much by up to 1 / cos(pi / k), 0.15 dB at 12 sides.

namespace sonarsim {

/// Facets further off the direction to the sonar than this many slopes have no echo (-54 dB).
inline constexpr float highlight_slopes = 5.0F;

/// The objects of a ping that are sampled triangle by triangle.
struct TargetSurface {
    std::vector<std::uint32_t> instances;  ///< ascending
    std::vector<Sample> pieces;            ///< the visible ones, instance after instance

    bool has(std::uint32_t instance) const {
        return std::ranges::binary_search(instances, instance);
    }
};

/// Samples those objects that the samples of an engine cannot represent in this view, because they
/// or their highlights are few resolution cells across. Their triangles are cut into pieces, each
/// with the place, the normal and the area of the curved surface that the mesh stands for. A piece
/// is seen if a ray from the sonar reaches it. The result does not depend on the engine.
TargetSurface target_surface(const TargetShapes& shapes, const View& view, const Scene& scene,
                             const VisibilityEngine& engine, const Pose& T_world_sensor);

/// Replaces an engine's samples of these objects.
void replace_samples(const TargetSurface& targets, const View& view, Samples& samples);

}  // namespace sonarsim
