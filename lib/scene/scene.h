#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

struct Water {
    double density_kg_m3 = 997.0;
    double sound_speed_m_s = 1480.0;
};

struct Material {
    std::string name;
    double density_kg_m3 = 0.0;
    double sound_speed_m_s = 0.0;
    float reflection = 0.0F;      ///< power reflection coefficient at normal incidence, Eq. 4
    double lambert_db = -27.0;    ///< 10 log mu of Lambert's rule, for the calibrated model
    double slope_rms_deg = 10.0;  ///< of its facets, likewise; 0: it has none
};

/// The power reflection coefficient at normal incidence, ((z - z_w) / (z + z_w))^2 with the
/// impedance z = rho c, Eq. 4-5.
double power_reflection(double density_kg_m3, double sound_speed_m_s, const Water& water);

/// The surface of the water, which mirrors sound from below and is no part of what a sonar sees.
struct WaterSurface {
    double height_m = 0.0;    ///< world
    float reflection = 0.0F;  ///< of power
};

/// What was left out of the scene while it was read, and why.
struct SceneRejects {
    std::uint64_t degenerate_triangles = 0;  ///< no area
    std::uint64_t non_finite_triangles = 0;  ///< a vertex is NaN or infinite
    std::uint64_t skipped_primitives = 0;    ///< points and lines: no surface to echo
};

/// A part of the scene that moves as one. Its vertices are floats in a frame of its own, which a
/// pose takes to the world for every ping.
struct Body {
    std::uint32_t instance = 0;  ///< index into Scene::instances
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
    std::vector<std::uint32_t> triangle_material;         ///< index into Scene::materials
};

/// A mesh that stands in the scene many times. Its vertices are floats in a frame of its own.
struct SharedMesh {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
    std::vector<std::uint32_t> triangle_material;         ///< index into Scene::materials
};

/// A place where a shared mesh stands still.
struct MeshCopy {
    std::uint32_t mesh = 0;      ///< index into Scene::shared_meshes
    std::uint32_t instance = 0;  ///< index into Scene::instances
    /// Turns, moves and scales by the same factor along all axes.
    Eigen::Affine3d T_world_mesh = Eigen::Affine3d::Identity();
};

/// The world as triangles, immutable once read. World frame: right-handed, z up, metres.
/// Vertices are floats relative to `origin`, which lies near the scene's centre, so that
/// UTM-sized coordinates lose nothing: p_world = origin + p.
struct Scene {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
    std::vector<std::uint32_t> triangle_material;         ///< index into `materials`
    std::vector<std::uint32_t> triangle_instance;         ///< index into `instances`
    std::vector<Body> bodies;                             ///< what moves is not in `triangles`
    std::vector<SharedMesh> shared_meshes;                ///< what stands in it many times
    std::vector<MeshCopy> copies;                         ///< is not in `triangles` either
    std::vector<Material> materials;                      ///< those that the scene uses
    std::vector<std::string> instances;                   ///< node names
    std::vector<std::string> instance_classes;  ///< extras.sonar.class, by instance; "": none
    Eigen::Vector3d bounds_min = Eigen::Vector3d::Zero();  ///< world frame
    Eigen::Vector3d bounds_max = Eigen::Vector3d::Zero();
    /// Floats far from the origin of their own file or node are coarse: a vertex may lie this far
    /// from where its maker put it, m. At UTM coordinates 0.25 m; a node that has them as its
    /// translation loses nothing.
    double vertex_rounding_m = 0.0;
    std::optional<WaterSurface> water_surface;
    SceneRejects rejects;
    std::vector<std::string> doubts;  ///< what the user should look at, as sentences
};

/// Whether `vertex_rounding_m` spoils the scene: more than a millimetre, about the finest range bin
/// (8,192 of them over 10 m), or than 1e-4 of a scene below 10 m; and more than 1e-6 of the scene,
/// since floats about its own centre are no better than 6e-8.
bool has_coarse_vertices(const Scene& scene);

}  // namespace sonarsim
