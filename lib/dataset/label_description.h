#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "assembly/assemble.h"

namespace sonarsim {

/// World boxes around the objects; empty for an object without triangles, and if a part of it
/// moves.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// An object that moves as a whole.
struct MovingObject {
    std::size_t body = 0;     ///< index into Scene::bodies
    Eigen::AlignedBox3d box;  ///< box around it in its own frame
};
/// One for each object; nothing for an object that stands still or consists of several parts.
std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly);

/// The names of the ids of labels for dataset.json, with the world boxes (m) of instances; null as
/// in object_boxes().
nlohmann::ordered_json describe_label_ids(const Assembly& assembly);

/// `labels.annotations` of dataset.json: the names of the classes that are background.
nlohmann::ordered_json describe_annotations(const SceneObjects& objects);

}  // namespace sonarsim
