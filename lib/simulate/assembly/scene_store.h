#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/scene/gltf/scene_files.h"
#include "input/scene/placed_file.h"
#include "input/scene/placing/bottom.h"
#include "simulate/product/fan_store.h"

namespace sonarsim {

/// The variants of a mission often share the files of scenes, the last bottom made of them,
/// and the fans of pictures. Not thread-safe, except for the fans.
class SceneStore : public SceneFiles {
  public:
    const std::shared_ptr<FanStore> fans = std::make_shared<FanStore>();

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
