#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// Which pings' errors are estimated, and what came out. Of each view those of a few pings, chosen
/// by their poses alone: the same whatever the order in which pings are rendered, and by whom.
class GoalCheck {
  public:
    /// Whether the error of this ping is still wanted.
    bool wants(const View& view, const Pose& T_world_sensor) const;

    /// Notes the estimated relative L1 of a ping.
    void add(const View& view, const Pose& T_world_sensor, double error);

    /// A sentence for every view with an estimate above its goal. `fixed_leaf_m` is
    /// octree.leaf_m, 0 where the leaf follows the goal.
    std::vector<std::string> warnings(double fixed_leaf_m) const;

  private:
    struct OfView {
        View view;
        std::map<std::uint64_t, double> errors;  ///< by the pose's number, the least of them
    };

    const OfView* find(const View& view) const;

    mutable std::mutex lock_;
    std::vector<OfView> views_;
};

}  // namespace sonarsim
