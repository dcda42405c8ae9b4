#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "assembly/assemble.h"

namespace sonarsim {

/// The box around all of each object, world frame; empty where none of its triangles is in the
/// scene, and where some of it moves.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// An object that moves as a whole.
struct MovingObject {
    std::size_t body = 0;     ///< index into Scene::bodies
    Eigen::AlignedBox3d box;  ///< around all of it, in the frame that moves
};
/// By object; nothing for those that stand still and those of several parts of which one moves.
std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly);

/// For dataset.json: what the ids of the labels stand for. Of an instance also the box around all
/// of it, world frame, m; null as in object_boxes().
nlohmann::ordered_json describe_label_ids(const Assembly& assembly);

}  // namespace sonarsim
