#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <vector>

#include "assembly/assemble.h"

namespace sonarsim {

/// The box around all of each object, world frame; empty where none of its triangles is in the
/// scene.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// For dataset.json: what the ids of the labels stand for. Of an instance also the box around all
/// of it, world frame, m; null where none of its triangles is in the scene.
nlohmann::ordered_json describe_label_ids(const Assembly& assembly);

}  // namespace sonarsim
