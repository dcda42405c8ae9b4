#pragma once

#include <span>

#include "input/scene/scene.h"

namespace sonarsim {

/// A triangle of an object, as part of the curved surface that its mesh represents.
struct TargetTriangle {
    std::array<std::uint32_t, 3> corners;    ///< indices into TargetShape::vertices
    std::array<Eigen::Vector3f, 3> normals;  ///< unit, of the curved surface at the corners
    Eigen::Vector3f normal;                  ///< unit, of the triangle, on the same side
    float curvature_m;                       ///< radius of curvature, negative if hollow; 0: flat
    std::uint32_t material;                  ///< index into Scene::materials
    std::uint32_t region;                    ///< triangles that join smoothly have one number
};

/// The surface of an object, in its own frame.
struct TargetShape {
    std::vector<Eigen::Vector3f> vertices;  ///< m
    std::vector<TargetTriangle> triangles;
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< centre of a ball around it
    float radius_m = 0.0F;                             ///< radius of that ball
    /// Greatest radius of curvature of its triangles; 0: all faces are flat.
    float curvature_m = 0.0F;
    float turn = 0.0F;    ///< greatest angle between the curved surface and a triangle of it, rad
    bool closed = false;  ///< normals point outwards, and the back of a triangle is never seen
    float min_slope = 1.0F;  ///< the least RMS slope of its materials that have facets
};

/// The triangles of an object by their corners and materials.
struct TargetMesh {
    std::span<const Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> materials;
};

/// Normals are interpolated over edges at which two triangles meet at less than 30 degrees, so a
/// coarse mesh of a sphere is a sphere, and a cube keeps its faces. An edge is a crease nonetheless
/// if one of the triangles reaches much further off it than the other: a large face next to a
/// narrow bevel is flat. Triangles that occur twice are kept once.
TargetShape target_shape(const TargetMesh& mesh);

/// An object of the scene that pings may sample triangle by triangle: an instance.
struct PlacedTarget {
    std::uint32_t shape;     ///< index into TargetShapes::shapes
    std::uint32_t instance;  ///< index into Scene::instances
    /// Index into Scene::bodies, if it moves: its shape is in the body's frame.
    std::optional<std::uint32_t> body;
    /// Rotation, uniform scale and translation, scene-local, if it is at rest.
    Eigen::Affine3f T_local_shape;
    float min_slope;  ///< the least of its shape, or of the texels on it if less
};

struct TargetShapes {
    std::vector<TargetShape> shapes;
    std::vector<PlacedTarget> placed;
};

/// Finds the instances of at most 20,000 triangles within a ball of at most 5 m radius. Null: none.
std::shared_ptr<const TargetShapes> find_target_shapes(const Scene& scene);

}  // namespace sonarsim
