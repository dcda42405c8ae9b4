#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/mission/scene_keys.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/placing/rest.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// The ground that objects cover, seen from above. A hull is compared only with those near it, so
/// that the time to scatter objects grows with their number and not with its square.
class TakenGround {
  public:
    void add(Hull hull);

    /// True if a hull comes nearer than `spacing_m` to none of those that were added.
    bool has_room(const Hull& room, double spacing_m) const;

  private:
    /// Hulls of about one size, by the column and row of the square cell that holds the middle of
    /// their box. Only cells with a hull are kept, in order.
    using Cells = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Hull>>;

    /// The cells of each size, m, by its binary exponent. Cells are wider than their hulls.
    std::map<int, Cells> levels_;
};

struct ScatteredObject {
    std::size_t shape = 0;
    Eigen::Affine3d T_world_shape = Eigen::Affine3d::Identity();
};

/// The attitude, scale and depth at which an object rests on the bottom.
struct Stance {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    double scale = 1.0;
    bool align = false;
    double bury_m = 0.0;
};

/// The transform that puts `shape` on the bottom above or below `position`, so that it touches the
/// bottom, and then lowers it by `bury_m`. Returns nullopt if a part of it would have no bottom.
std::optional<Eigen::Affine3d> put_on_bottom(const Bottom& bottom, const Surface& shape,
                                             const Eigen::Vector2d& position, const Stance& stance);

/// Draws the objects of a rule, the `rule_index`-th of the mission, with shapes of its files in
/// their own frames, and adds their hulls to `taken`. No hull comes nearer to another than the
/// spacing. The properties of an object are drawn once, its position up to a thousand times; scale
/// and burial are drawn again for an object that lies wholly below the bottom. Every draw depends
/// on the seed, the rule and the object, not on earlier draws. InputError at the rule's place if an
/// object finds no room or always lies below.
std::vector<ScatteredObject> scatter(const ScatterConfig& rule,
                                     std::span<const Surface* const> shapes,
                                     std::uint32_t rule_index, std::uint64_t seed,
                                     const Bottom& bottom, TakenGround& taken);

}  // namespace sonarsim
