#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

class GroundMaps;     // input/scene/maps/ground_maps.h
struct SoundProfile;  // simulate/water/sound_profile.h

struct Water {
    double density_kg_m3 = 997.0;
    double sound_speed_m_s = 1480.0;
};

struct Material {
    std::string name;
    double density_kg_m3 = 0.0;
    double sound_speed_m_s = 0.0;
    float reflection = 0.0F;  ///< power reflection coefficient at normal incidence, Eq. 4

    // The rest is for the calibrated model (docs/calibrated.md). Lambert's rule and facets:
    double lambert_db = -27.0;  ///< 10 log mu of Lambert's rule
    /// Roughness that flow meets; with it `lambert_db` is the part from inside, if there is any.
    std::optional<double> roughness_mm = {};
    double slope_rms_deg = 10.0;         ///< RMS slope of the facets; 0: no facets
    std::optional<double> wall_mm = {};  ///< thickness of a wall with water behind; empty: solid
    // The model of sea beds (calibrated/equation/seafloor_scattering.h), if there is a grain size
    // or a loss parameter. A value that is empty follows from the grain size.
    std::optional<double> grain_phi = {};       ///< mean grain size, -log2 of millimetres
    std::optional<double> loss_parameter = {};  ///< imaginary part / real part of the wave number
    std::optional<double> spectral_strength_cm4 = {};  ///< w2 of the roughness spectrum
    std::optional<double> spectral_exponent = {};      ///< exponent of that spectrum
    std::optional<double> volume_parameter = {};       ///< scattering / absorption cross-section

    std::string prevails = {};  ///< a mixture: the material of its label; "": no mixture

    bool operator==(const Material&) const = default;
};

/// The power reflection coefficient ((z - z_w) / (z + z_w))^2 with z = rho c, Eq. 4-5.
inline double power_reflection(double density_kg_m3, double sound_speed_m_s, const Water& water) {
    const double z = density_kg_m3 * sound_speed_m_s;
    const double z_w = water.density_kg_m3 * water.sound_speed_m_s;
    const double ratio = (z - z_w) / (z + z_w);
    return ratio * ratio;
}

/// The surface of the water. It reflects sound from below specularly.
struct WaterSurface {
    /// Surface in that of the water counts as below it, with its rounding. Chosen.
    static constexpr double slack_m = 1e-3;

    double height_m = 0.0;    ///< world
    float reflection = 0.0F;  ///< power reflection coefficient
    /// Speed of the wind whose waves scatter sound back; empty: the surface has no echo.
    std::optional<double> wind_m_s = {};
};

/// Counts of what was dropped while the scene was read, by reason.
struct SceneRejects {
    std::uint64_t degenerate_triangles = 0;  ///< no area
    std::uint64_t non_finite_triangles = 0;  ///< a vertex is NaN or infinite
    std::uint64_t skipped_primitives = 0;    ///< points and lines, which have no surface
};

/// A mesh that occurs in the scene many times. Its vertices are floats in the mesh's own frame.
struct SharedMesh {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
    std::vector<std::uint32_t> triangle_material;         ///< index into Scene::materials
};

/// A part of the scene that moves rigidly: a mesh in the body's frame, with a pose by ping.
struct Body : SharedMesh {
    std::uint32_t instance = 0;  ///< index into Scene::instances
};

/// An instance of a shared mesh, at rest.
struct MeshCopy {
    std::uint32_t mesh = 0;      ///< index into Scene::shared_meshes
    std::uint32_t instance = 0;  ///< index into Scene::instances
    /// Rotation, translation and a uniform scale.
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
    /// So many of the first triangles and vertices are those of the first file; 0 if it moves.
    std::size_t first_file_triangles = 0, first_file_vertices = 0;
    std::vector<Body> bodies;  ///< movable parts; their triangles are not in `triangles`
    std::vector<SharedMesh> shared_meshes;      ///< meshes of the copies
    std::vector<MeshCopy> copies;               ///< their triangles are not in `triangles` either
    std::vector<Material> materials;            ///< used by its surfaces and maps
    std::vector<std::string> instances;         ///< node names
    std::vector<std::string> own_names;         ///< the same in the files, where they may be equal
    std::vector<std::string> instance_classes;  ///< extras.sonar.class of each instance; "": none
    std::vector<std::uint8_t> is_bottom;        ///< 1: all of this instance is the bottom
    Eigen::Vector3d bounds_min = Eigen::Vector3d::Zero();  ///< world frame
    Eigen::Vector3d bounds_max = Eigen::Vector3d::Zero();
    /// Largest rounding error of a vertex, m. Floats far from the origin of their own file or node
    /// are coarse: at UTM coordinates the error is 0.25 m; the translation of a node loses nothing.
    double vertex_rounding_m = 0.0;
    std::optional<WaterSurface> water_surface;
    std::shared_ptr<const GroundMaps> maps;  ///< maps of instances; null: none
    /// The profile that bends sound; null: paths are straight at the speed of `Water`.
    std::shared_ptr<const SoundProfile> sound_profile;
    SceneRejects rejects;
    std::vector<std::string> warnings;  ///< sentences for the user
};

/// True if `vertex_rounding_m` spoils the scene: it is more than a millimetre, about the finest
/// range bin (8,192 of them over 10 m), or more than 1e-4 of a scene below 10 m. It must also be
/// more than 1e-6 of the scene, since floats about its own centre have errors of up to 6e-8.
inline bool has_coarse_vertices(const Scene& scene) {
    const double size = (scene.bounds_max - scene.bounds_min).maxCoeff();
    return scene.vertex_rounding_m > std::max(std::min(1e-3, 1e-4 * size), 1e-6 * size);
}

}  // namespace sonarsim
