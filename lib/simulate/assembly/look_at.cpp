#include "simulate/assembly/look_at.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "core/units.h"
#include "input/scene/copies.h"

namespace sonarsim {

namespace {

constexpr double clearance_m = 0.2;  // between the vehicle and the boxes of objects
constexpr std::uint32_t tries = 1000;

/// World boxes around the objects at rest that are no background; empty for the others.
std::vector<Eigen::AlignedBox3d> boxes_of_objects(const Scene& scene, const SceneObjects& objects) {
    std::vector<Eigen::AlignedBox3d> boxes(objects.objects.size());
    const std::vector<Eigen::AlignedBox3d> of_instances = boxes_of_instances(scene);
    for (std::uint32_t i = 0; i < of_instances.size(); ++i) {
        const std::uint32_t object = objects.object_of(i);
        if (!objects.is_background(object)) boxes[object].extend(of_instances[i]);
    }
    return boxes;
}

/// The objects that are looked at: indices into `boxes`.
std::vector<std::uint32_t> looked_at(const std::string& name, const SceneObjects& objects,
                                     const std::vector<Eigen::AlignedBox3d>& boxes) {
    std::vector<std::uint32_t> chosen;
    std::vector<std::string> classes{all_objects};
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        if (boxes[k].isEmpty()) continue;
        classes.push_back(objects.classes[objects.class_of(k)]);
        if (name == all_objects || name == classes.back()) chosen.push_back(k);
    }
    if (!chosen.empty()) return chosen;
    std::string all;
    for (const std::string& one : classes)
        all += (all.empty() ? "" : ", ") + printable(one);
    throw InputError("trajectory.look_at: the scene has no object at rest of '" + printable(name) +
                     "' that is no background" + did_you_mean(name, classes) +
                     "; there are: " + all);
}

double drawn_in(const std::array<double, 2>& limits, double share) {
    return limits[0] + share * (limits[1] - limits[0]);
}

/// A pose with the middle of a box in view, by two blocks of random words.
Pose pose_before(const Eigen::AlignedBox3d& box, const LookAtTrajectoryConfig& config,
                 const PhiloxBlock& a, const PhiloxBlock& b) {
    const double range_m = drawn_in(config.range_m, unit_double(a.x0, a.x1));
    const double bearing_rad = radians(drawn_in(config.bearing_deg, unit_double(a.x2, a.x3)));
    const double height_m = drawn_in(config.height_m, unit_double(b.x0, b.x1));
    const double azimuth_rad = 2.0 * pi * unit_double(b.x2, b.x3);
    const SinCos to_object = sincos(azimuth_rad);
    Pose pose;
    pose.translation = {box.center().x() - range_m * to_object.cos,
                        box.center().y() - range_m * to_object.sin, box.min().z() + height_m};
    pose.rotation = rotation_from_rpy(0.0, 0.0, azimuth_rad - bearing_rad);
    return pose;
}

}  // namespace

Trajectory look_at_poses(const LookAtTrajectoryConfig& config, const Scene& scene,
                         const SceneObjects& objects, std::uint64_t seed) {
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_objects(scene, objects);
    const std::vector<std::uint32_t> chosen = looked_at(config.look_at, objects, boxes);
    const PhiloxKey key = stream_key(seed, 0, 0, stream_named("look at"));
    const auto has_room = [&](const Eigen::Vector3d& place) {
        return (place.head<2>().array() >= scene.bounds_min.head<2>().array()).all() &&
               (place.head<2>().array() <= scene.bounds_max.head<2>().array()).all() &&
               std::ranges::none_of(boxes, [&](const Eigen::AlignedBox3d& box) {
                   return !box.isEmpty() && box.exteriorDistance(place) < clearance_m;
               });
    };
    Trajectory poses;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(config.count); ++i) {
        for (std::uint32_t k = 0; std::ssize(poses) == i; ++k) {
            if (k == tries) {
                throw InputError(
                    "trajectory.look_at: no pose at range_m and height_m lies within "
                    "the scene and outside of its objects; change range_m or height_m");
            }
            const PhiloxBlock pick = philox({i, k, 0, 0}, key);
            const auto nth = static_cast<std::size_t>(unit_double(pick.x0, pick.x1) *
                                                      static_cast<double>(chosen.size()));
            const Pose pose = pose_before(boxes[chosen[nth]], config, philox({i, k, 1, 0}, key),
                                          philox({i, k, 2, 0}, key));
            if (has_room(pose.translation)) poses.push_back({static_cast<double>(i), pose});
        }
    }
    return poses;
}

}  // namespace sonarsim
