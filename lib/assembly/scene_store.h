#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"
#include "scene/placing/bottom.h"

namespace sonarsim {

/// The files of scenes, and the last bottom made of them, which the variants of a mission often
/// share. Not thread-safe.
class SceneStore : public SceneFiles {
  public:
    /// The bottom that the nodes of a placed file form; no patterns: all nodes. InputError as
    /// surface_of().
    std::shared_ptr<const Bottom> bottom(const PlacedFile& placed,
                                         const std::vector<std::string>& nodes);

  private:
    PlacedFile placed_;
    std::vector<std::string> nodes_;
    std::shared_ptr<const Bottom> bottom_;
};

}  // namespace sonarsim
