#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/pose.h"
#include "product/annotation.h"

// The parts of JSON files as every file of a dataset has them.

namespace sonarsim {

template <class Vector>
nlohmann::ordered_json describe_vector(const Vector& v) {
    return {v.x(), v.y(), v.z()};
}

/// Null for an empty box.
template <class Scalar>
nlohmann::ordered_json describe_box(const Eigen::AlignedBox<Scalar, 3>& box) {
    if (box.isEmpty()) return nullptr;
    return {{"min", describe_vector(box.min())}, {"max", describe_vector(box.max())}};
}

/// A box of pixels.
nlohmann::ordered_json describe_box(const PixelBox& box);

/// Position in metres; quaternion as x, y, z, w.
nlohmann::ordered_json describe_pose(const Pose& pose);

/// JSON as it is written: indented, with a line feed at the end.
std::string json_text(const nlohmann::ordered_json& json);

/// The file of the objects in a picture, a line each; `head` says which picture it is.
std::string objects_text(const nlohmann::ordered_json& head,
                         const std::vector<nlohmann::ordered_json>& objects);

}  // namespace sonarsim
