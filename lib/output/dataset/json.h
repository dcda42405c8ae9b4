#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/pose.h"
#include "simulate/product/picture.h"

// The parts of JSON files as every file of a dataset has them.

namespace sonarsim {

/// Keys keep the order in which they are added.
using Json = nlohmann::ordered_json;

template <class Vector>
Json describe_vector(const Vector& v) {
    return {v.x(), v.y(), v.z()};
}

/// Null for an empty box.
template <class Scalar>
Json describe_box(const Eigen::AlignedBox<Scalar, 3>& box) {
    if (box.isEmpty()) return nullptr;
    return {{"min", describe_vector(box.min())}, {"max", describe_vector(box.max())}};
}

/// A box of pixels.
Json describe_box(const PixelBox& box);

/// Position in metres; quaternion as x, y, z, w.
Json describe_pose(const Pose& pose);

/// Rounded to multiples of 1 / `parts`; null for none.
Json rounded(const std::optional<double>& value, double parts);

/// JSON as it is written: indented, with a line feed at the end.
std::string json_text(const Json& json);
/// JSON on one line, without a line feed.
std::string json_line(const Json& json);

/// Encodes the runs of a mask as COCO's compressed RLE: each number in groups of five bits, the
/// lowest first, as characters from '0' on; the sixth bit says that more groups follow. From the
/// fourth number on, the difference from the number two places before is written.
std::string coco_counts(std::span<const std::uint32_t> runs);

/// The file of the objects in a picture, a line each; `head` says which picture it is.
std::string objects_text(const Json& head, const std::vector<Json>& objects);

}  // namespace sonarsim
