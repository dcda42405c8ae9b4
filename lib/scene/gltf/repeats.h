#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "scene/gltf/mesh_builder.h"
#include "scene/gltf/primitives.h"
#include "scene/scene.h"

namespace sonarsim {

/// A file that the scene places several times, as if it were placed at the origin.
struct RepeatedFile {
    PlacedFile placed;
    OpenFile open;
};

/// The files of a scene that become shared meshes.
struct Repeats {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    std::deque<RepeatedFile> files;    ///< a deque, since `open` points to `placed`
    std::vector<std::size_t> of_file;  ///< index into `files` for each file of the scene, or `none`
};

/// Finds the files that have names, do not move and are read more than once in the same way.
/// Returns none if they have at most `sharing_threshold` triangles together, counted as often as
/// they are placed. InputError if there are more triangles than 32 bits can number.
Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t sharing_threshold);

/// Makes the shared meshes of a scene, each when its first copy is added.
class SharedMeshes {
  public:
    explicit SharedMeshes(const Repeats& repeats);

    /// Adds a copy of the `repeat`-th repeated file where `file` is placed.
    void add_copy(std::size_t repeat, const OpenFile& file, const MaterialRules& rules,
                  ReadingLimit& limit, MaterialNumbers& materials, Scene& scene);

  private:
    struct Made {
        bool is_made = false;
        std::uint32_t mesh = 0;  ///< index into Scene::shared_meshes
        /// Centre of the mesh, in the file's frame.
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        std::string class_name = {};
    };

    const Repeats& repeats_;
    std::vector<Made> made_;
};

}  // namespace sonarsim
