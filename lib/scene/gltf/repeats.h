#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "scene/gltf/mesh_builder.h"
#include "scene/gltf/pieces.h"
#include "scene/scene.h"

namespace sonarsim {

/// A file that the scene has in several places, as if it stood at the origin.
struct RepeatedFile {
    PlacedFile placed;
    OpenFile open;
};

/// The files of a scene that become shared meshes.
struct Repeats {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    std::deque<RepeatedFile> files;    ///< a deque, since `open` points to `placed`
    std::vector<std::size_t> of_file;  ///< index into `files` by file of the scene, or `none`
};

/// Files that are read alike more than once, have names and do not move. None of them when they
/// have no more than `share_beyond` triangles together, each counted as often as it is placed.
/// InputError when there are more triangles than 32 bits can number.
Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t share_beyond);

/// Makes the shared meshes of a scene, each when its first copy comes.
class SharedMeshes {
  public:
    explicit SharedMeshes(const Repeats& repeats);

    /// Adds a copy of the `repeat`-th repeated file where `file` is placed.
    void add_copy(std::size_t repeat, const OpenFile& file, const MaterialRules& rules,
                  ReadingLimit& limit, MaterialNumbers& materials, Scene& scene);

  private:
    struct Made {
        bool is_made = false;
        std::uint32_t mesh = 0;                            ///< index into Scene::shared_meshes
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the mesh, in the file's frame
        std::string class_name = {};
    };

    const Repeats& repeats_;
    std::vector<Made> made_;
};

}  // namespace sonarsim
