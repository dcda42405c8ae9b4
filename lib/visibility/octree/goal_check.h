#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// Selects pings for an estimate of their error, and stores the estimates. Each view has a few such
/// pings, chosen only by their poses: they do not depend on the order in which pings are rendered,
/// nor on threads.
class GoalCheck {
  public:
    /// True if the error of this ping should be estimated.
    bool wants(const View& view, const Pose& T_world_sensor) const;

    /// Stores the estimated relative L1 of a ping.
    void add(const View& view, const Pose& T_world_sensor, double error);

    /// One warning for every view with an estimate above its goal. `fixed_leaf_m` is octree.leaf_m,
    /// 0 if the leaf size follows the goal.
    std::vector<std::string> warnings(double fixed_leaf_m) const;

  private:
    struct OfView {
        View view;
        /// The entries with the least hashes of their poses.
        std::map<std::uint64_t, double> errors;
    };

    const OfView* find(const View& view) const;

    mutable std::mutex lock_;
    std::vector<OfView> views_;
};

}  // namespace sonarsim
