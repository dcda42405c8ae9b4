#pragma once

#include "input/scene/scene.h"

namespace sonarsim::test {

// Test scenes with simple geometry, built in memory. Materials are named by their reflection.

/// An empty scene for shapes. `origin` becomes Scene::origin; shapes are relative to it.
Scene empty_scene(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The index of a material with power reflection coefficient `reflection`.
std::uint32_t add_material(Scene& scene, float reflection);

/// A triangle of the last instance.
void add_triangle(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                  const Eigen::Vector3f& c, std::uint32_t material);

/// A quadrilateral a, b, c, d (in order around it), cut into n x n x 2 triangles.
void add_quad(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
              const Eigen::Vector3f& c, const Eigen::Vector3f& d, std::uint32_t material,
              int n = 1);

/// The rectangle between two opposite corners that have one coordinate in common.
void add_rectangle(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& c,
                   std::uint32_t material, int n = 1);

/// The horizontal square |x|, |y| <= half_size at height z.
void add_floor(Scene& scene, float half_size, float z, std::uint32_t material, int n = 1);

/// Scenes of such a rectangle or floor alone, of one material.
Scene rectangle_scene(const Eigen::Vector3f& a, const Eigen::Vector3f& c, float reflection,
                      int n = 1);
Scene floor_scene(float half_size, float z, float reflection, int n = 1);

/// An axis-aligned box.
void add_box(Scene& scene, const Eigen::Vector3f& min, const Eigen::Vector3f& max,
             std::uint32_t material);

/// A sphere of n meridians and n / 2 parallels, its vertices on the sphere.
void add_sphere(Scene& scene, const Eigen::Vector3f& centre, float radius, std::uint32_t material,
                int n = 256);

/// An upright cylinder without caps, of n sides.
void add_pole(Scene& scene, const Eigen::Vector3f& foot, float radius, float height,
              std::uint32_t material, int n = 64);

/// A prism from a to b, as a part of the last instance; closed by fans about a and b, so that the
/// bars that meet in a node share its vertex.
void add_bar(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b, float radius,
             int sides, bool closed, std::uint32_t material);

/// Scenes of such a sphere or box alone, of one material.
Scene sphere_scene(const Eigen::Vector3f& centre, float radius, float reflection, int n = 256);
Scene box_scene(const Eigen::Vector3f& min, const Eigen::Vector3f& max, float reflection);

/// A tank of 8 x 6 x 3 m, floor at z = 0, with a pole, a box, a crate and a sphere in it.
Scene tank();

/// A sea floor of waves about z = 0, |x|, |y| <= 30 m: swell of half a metre, ripples of 4 cm, two
/// materials. For comparisons with a reference.
Scene rough_floor();

}  // namespace sonarsim::test
