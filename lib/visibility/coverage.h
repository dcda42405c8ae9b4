#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pose.h"
#include "visibility/triangle_runs.h"
#include "visibility/view.h"

namespace sonarsim {

/// 1 for the bins of a view that contain surface, visible or hidden, else 0: [beams, range bins],
/// beam after beam. Surface within a thousandth of a bin of a border may count on either side.
std::vector<std::uint8_t> covered_bins(const TriangleRuns& surface, const View& view,
                                       const Pose& T_world_sensor,
                                       std::span<const Pose> T_world_body = {});

/// Coverage of one scene, for an engine. `ready`: the runs of triangles are made once for all
/// pings; otherwise every call makes them, which takes 10 ms for a million triangles.
class SceneCoverage {
  public:
    /// `scene` must outlive this object.
    SceneCoverage(const Scene& scene, bool ready)
        : scene_(&scene), runs_(ready ? std::make_shared<const TriangleRuns>(scene) : nullptr) {}

    /// See covered_bins() above.
    std::vector<std::uint8_t> bins(const View& view, const Pose& T_world_sensor,
                                   std::span<const Pose> T_world_body = {}) const {
        return covered_bins(runs_ ? *runs_ : TriangleRuns(*scene_), view, T_world_sensor,
                            T_world_body);
    }

  private:
    const Scene* scene_;
    std::shared_ptr<const TriangleRuns> runs_;
};

}  // namespace sonarsim
