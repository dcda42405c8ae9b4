#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "input/scene/materials.h"
#include "input/scene/placed_file.h"
#include "input/scene/scene.h"
#include "input/scene/surface.h"

namespace tinygltf {
class Model;
}

namespace sonarsim {

/// Reads a .gltf or .glb file into tinygltf's structs, without its textures, animations, skins and
/// cameras. Sizes, indices and offsets are not checked, and a value of a wrong type is a default.
/// Reads at most 2 GiB, external buffers included. InputError for a faulty file.
tinygltf::Model read_gltf(const std::filesystem::path& path);

/// Reads files of meshes, each only once, and keeps them. Not thread-safe.
class SceneFiles {
  public:
    SceneFiles() = default;
    SceneFiles(const SceneFiles&) = delete;
    /// Reads the file on the first call. InputError as read_gltf and read_mesh, with the place in
    /// the mission that names the file. The reference stays valid; a reference to a heightmap or a
    /// seabed only until another one, or another part of it, is read.
    const tinygltf::Model& model(const PlacedFile& placed);

  private:
    struct Entry;
    std::vector<std::shared_ptr<const Entry>>
        entries_;  ///< pointers, so that references stay valid
};

/// For load_scene: no meshes are shared; every copy of a file becomes triangles of the scene.
inline constexpr std::size_t share_nothing = std::numeric_limits<std::size_t>::max();

/// Reads .gltf or .glb files (their content says which), and .obj, .stl and .ply files as
/// read_mesh() does, each where it is placed; files that move become bodies. The scene is bit by
/// bit that of one file that holds all nodes in the same order, with the same transforms.
///
/// World frame: (x, y, z)_world = (x, -z, y)_gltf, node transforms composed in double precision.
/// Reads a file's default scene, else its first, else all root nodes. A triangle's material is the
/// first that exists of: `extras.sonar.material` of its node or of the nearest ancestor that has
/// one, `extras.sonar.material` of its glTF material, the name of that material. Its instance is
/// its node's name; a node without one is "node<index>", and a name that is taken gets "_2", "_3",
/// ... Its class is `extras.sonar.class` of the node or of the nearest ancestor that has one, else
/// of the glTF materials. Animated nodes and morph targets stay at rest. `origin` is the centre of
/// the bounding box rounded to a multiple of g, the smallest power of ten that holds the scene's
/// largest extent (at least 1 m), so that a scene moved by multiples of g keeps its coordinates.
///
/// Materials without a name or without a row in `table` become `material_default`, unless that is
/// empty. Named files that do not move and are placed more than once become shared meshes with
/// copies, if all their copies have more than `sharing_threshold` triangles together.
///
/// InputError for an invalid glTF 2.0 file, for compressed or skinned meshes, unknown required
/// extensions, buffers outside of the file's folder, primitives without material, and materials
/// that the table lacks. InputError at the place of the file in the mission for a name that is
/// taken, and for a material to rename that the file lacks. Points, lines, degenerate and
/// non-finite triangles are dropped and counted in `rejects`; a scene may end up empty.
Scene load_scene(std::span<const PlacedFile> files, SceneFiles& models, const MaterialTable& table,
                 const std::string& material_default, const Water& water,
                 std::size_t sharing_threshold = share_nothing);

/// Reads one file without a table of materials: materials have only a name, or "(no material)".
Scene load_scene_geometry(const PlacedFile& file, SceneFiles& models);
Scene load_scene_geometry(const std::filesystem::path& path);

/// The triangles of a placed file, or only of its nodes that match one of `nodes`. InputError as
/// load_scene, and at the place of the file for a pattern that matches no node.
Surface surface_of(const PlacedFile& file, SceneFiles& models,
                   std::span<const std::string> nodes = {});

}  // namespace sonarsim
