#pragma once

#include <deque>
#include <functional>
#include <map>

#include "input/scene/gltf/load.h"
#include "input/scene/placed_file.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/surface.h"
#include "simulate/product/fan.h"
#include "simulate/visibility/caster.h"

namespace sonarsim {

/// The variants of a mission often share the files of scenes, the surfaces of objects, the last
/// bottom made of them and, for any number of threads, the trees of the first file and the fans.
class SceneStore : public SceneFiles {
  public:
    const std::shared_ptr<SharedTrees> trees = std::make_shared<SharedTrees>();
    const std::shared_ptr<FanStore> fans = std::make_shared<FanStore>();

    /// Gets a sentence before a part that takes many seconds is made, with a cure; may be null.
    std::function<void(const std::string&)> announce = {};

    /// The surface of a file; files read with the same options share one.
    const Surface& shape(const PlacedFile& file, const MeshConfig& mesh);

    /// The bottom that nodes of a placed file form; no patterns: all. InputError as surface_of().
    std::shared_ptr<const Bottom> bottom(const PlacedFile& placed,
                                         const std::vector<std::string>& nodes);

    /// The SHA-256 of an input file when it was first queried.
    const std::string& sum_of(const std::filesystem::path& file);

  private:
    struct Shape {
        std::filesystem::path file;
        MeshConfig mesh;
        Surface surface;
    };

    std::deque<Shape> shapes_;  ///< a deque, so that references stay valid
    std::map<std::filesystem::path, std::string> sums_;
    PlacedFile placed_;
    std::vector<std::string> nodes_;
    std::shared_ptr<const Bottom> bottom_;
};

}  // namespace sonarsim
