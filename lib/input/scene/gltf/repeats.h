#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "input/scene/gltf/extent.h"
#include "input/scene/gltf/mesh_builder.h"
#include "input/scene/gltf/primitives.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// A file that the scene places several times, as if it were placed at the origin.
struct RepeatedFile {
    PlacedFile placed;
    OpenFile open;
    SurfaceExtent extent = {};
    std::optional<std::uint32_t> mesh = {};  ///< index into Scene::shared_meshes, once it is made
    std::string class_name = {};             ///< class of its copies, as `mesh`
};

/// The files of a scene that become shared meshes.
struct Repeats {
    std::deque<RepeatedFile> files;      ///< a deque, since `open` points to `placed`
    std::vector<RepeatedFile*> by_file;  ///< for each file of the scene; null: it is not shared
};

/// Finds the files that have names, do not move and are read more than once in the same way.
/// Returns none if they have at most `sharing_threshold` triangles together, counted as often as
/// they are placed. InputError if there are more triangles than 32 bits can number.
Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t sharing_threshold,
                     ReadingLimit& limit);

/// Adds a copy of a repeated file where `file` is placed, after its mesh if it is the first.
void add_copy(RepeatedFile& repeated, const OpenFile& file, const MaterialRules& rules,
              ReadingLimit& limit, MaterialNumbers& materials, Scene& scene);

}  // namespace sonarsim
