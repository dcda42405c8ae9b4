#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// Selects pings for an estimate of their error, and stores the estimates. Each view has a few such
/// pings, chosen only by their poses: they do not depend on the order in which pings are prepared.
class GoalCheck {
  public:
    /// The place to store the estimated relative L1 of this ping; null if it needs no estimate.
    std::shared_ptr<double> place_for(const View& view, const Pose& T_world_sensor);

    /// One warning for every view with an estimate above its goal. `fixed_leaf_m` is octree.leaf_m,
    /// 0 if the leaf size follows the goal.
    std::vector<std::string> warnings(double fixed_leaf_m) const;

  private:
    struct OfView {
        View view;
        /// The entries with the least hashes of their poses; NaN until the ping has stored its
        /// estimate.
        std::map<std::uint64_t, std::shared_ptr<double>> errors;
    };

    std::vector<OfView> views_;
};

}  // namespace sonarsim
