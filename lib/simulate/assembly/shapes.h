#pragma once

#include <algorithm>
#include <deque>
#include <filesystem>

#include "input/mission/mission.h"
#include "input/scene/gltf/surface_of.h"
#include "input/scene/placed_file.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// The surfaces of files; files read with the same options share one.
class Shapes {
  public:
    explicit Shapes(SceneFiles& models) : models_(models) {}

    const Surface& of(const PlacedFile& file, const MeshConfig& mesh) {
        const auto known = std::ranges::find_if(shapes_, [&](const Shape& shape) {
            return shape.file.native() == file.file.native() && shape.mesh == mesh;
        });
        if (known != shapes_.end()) return known->surface;
        return shapes_.emplace_back(Shape{file.file, mesh, surface_of(file, models_)}).surface;
    }

  private:
    struct Shape {
        std::filesystem::path file;
        MeshConfig mesh;
        Surface surface;
    };

    SceneFiles& models_;
    std::deque<Shape> shapes_;  // a deque, so that references stay valid
};

}  // namespace sonarsim
