#include "core/elementary.h"
#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "core/units.h"
#include "input/scene/copies.h"
#include "simulate/assembly/poses.h"

namespace sonarsim {

namespace {

constexpr double clearance_m = 0.2;  // between the vehicle and the boxes of objects
constexpr std::uint32_t tries = 1000;

/// World boxes around the objects at rest that are no background; empty for the others.
std::vector<Eigen::AlignedBox3d> boxes_of_objects(const Scene& scene, const SceneObjects& objects) {
    std::vector<Eigen::AlignedBox3d> boxes(objects.objects.size());
    const std::vector<Eigen::AlignedBox3d> instance_boxes = boxes_of_instances(scene);
    for (std::uint32_t i = 0; i < instance_boxes.size(); ++i) {
        const std::uint32_t object = objects.object_of(i);
        if (!objects.is_background(object)) boxes[object].extend(instance_boxes[i]);
    }
    return boxes;
}

/// The names in a text, between commas.
std::vector<std::string> names_in(const std::string& text) {
    std::vector<std::string> names;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::size_t first = std::min(text.find_first_not_of(' ', from), to);
        const std::size_t last = to > first ? text.find_last_not_of(' ', to - 1) + 1 : first;
        names.push_back(text.substr(first, last - first));
        from = to + 1;
    }
    return names;
}

/// The objects to look at: indices into `boxes`; none if no object of their classes is there.
std::vector<std::uint32_t> looked_at(const LookAtTrajectoryConfig& config,
                                     const SceneObjects& objects,
                                     const std::vector<Eigen::AlignedBox3d>& boxes) {
    std::vector<std::uint32_t> chosen, small;
    std::vector<std::string> classes{all_objects};
    for (std::uint32_t k = 0; k < objects.classes.size(); ++k) {
        const bool has_boxes = std::ranges::any_of(boxes, [&](const Eigen::AlignedBox3d& box) {
            return !box.isEmpty() &&
                   objects.class_of(static_cast<std::uint32_t>(&box - boxes.data())) == k;
        });
        const bool is_absent = std::ranges::none_of(
            objects.objects, [&](const SceneObjects::Object& one) { return one.class_index == k; });
        const bool is_background = !objects.background.empty() && objects.background[k] != 0;
        if (has_boxes || (is_absent && !is_background)) classes.push_back(objects.classes[k]);
    }
    for (const std::string& name : names_in(config.look_at)) {
        bool is_known = name != all_objects && std::ranges::count(classes, name) > 0;
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            if (boxes[k].isEmpty()) continue;
            if (name != all_objects && name != objects.classes[objects.class_of(k)]) continue;
            chosen.push_back(k);
            if (name != all_objects || boxes[k].diagonal().norm() <= config.range_m[1])
                small.push_back(k);
            is_known = true;
        }
        if (is_known || (name == all_objects && classes.size() > 1)) continue;
        throw InputError("trajectory.look_at: the scene has no object at rest of '" +
                         printable(name) + "' that is no background" + did_you_mean(name, classes) +
                         "; there are: " + printable(listed(classes)));
    }
    return small.empty() ? chosen : small;
}

/// A drawn place at the bottom of the box around a scene.
Eigen::AlignedBox3d place_in(const Scene& scene, const PhiloxBlock& drawn) {
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    return Eigen::AlignedBox3d(Eigen::Vector3d(
        scene.bounds_min.x() + unit_double(drawn.x0, drawn.x1) * extent.x(),
        scene.bounds_min.y() + unit_double(drawn.x2, drawn.x3) * extent.y(), scene.bounds_min.z()));
}

double drawn_in(const std::array<double, 2>& limits, double share) {
    return limits[0] + share * (limits[1] - limits[0]);
}

/// The attitude of a sensor with an azimuth and depression of the world at its own direction.
Eigen::Quaterniond aimed(double azimuth_rad, double depression_rad, double own_azimuth_rad,
                         double own_elevation_rad) {
    const SinCos down = sincos(depression_rad);
    const SinCos side = sincos(own_azimuth_rad);
    const SinCos up = sincos(own_elevation_rad);
    const double to_port = std::clamp(up.cos * side.sin / std::max(down.cos, 1e-9), -1.0, 1.0);
    const double ahead = std::sqrt(1.0 - to_port * to_port);
    const double pitch = arctan2(up.sin, up.cos * side.cos) + arctan2(down.sin, down.cos * ahead);
    return rotation_from_rpy(0.0, pitch, azimuth_rad - arctan2(to_port, ahead));
}

/// A pose with the middle of a box in view, by two blocks of random words.
Pose pose_before(const Eigen::AlignedBox3d& box, const LookAtTrajectoryConfig& config,
                 const Pose* mount, const PhiloxBlock& a, const PhiloxBlock& b, double elevation) {
    const double range_m = drawn_in(config.range_m, unit_double(a.x0, a.x1));
    const double bearing_rad = radians(drawn_in(config.bearing_deg, unit_double(a.x2, a.x3)));
    const double height_m = drawn_in(config.height_m, unit_double(b.x0, b.x1));
    const double azimuth_rad = 2.0 * pi * unit_double(b.x2, b.x3);
    const SinCos to_object = sincos(azimuth_rad);
    Pose pose;
    pose.translation = {box.center().x() - range_m * to_object.cos,
                        box.center().y() - range_m * to_object.sin, box.min().z() + height_m};
    pose.rotation = rotation_from_rpy(0.0, 0.0, azimuth_rad - bearing_rad);
    if (!mount) return pose;
    const double below_m = pose.translation.z() - box.center().z();
    pose.rotation = (aimed(azimuth_rad, arctan2(below_m, range_m), bearing_rad,
                           radians(drawn_in(config.elevation_deg, elevation))) *
                     mount->rotation.conjugate())
                        .normalized();
    pose.translation -= pose.rotation * mount->translation;
    return pose;
}

}  // namespace

Trajectory look_at_poses(const LookAtTrajectoryConfig& config, const Scene& scene,
                         const SceneObjects& objects, const Pose* mount, std::uint64_t seed) {
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_objects(scene, objects);
    const std::vector<std::uint32_t> chosen = looked_at(config, objects, boxes);
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
            const PhiloxBlock more = philox({i, k, 3, 0}, key);
            const Pose pose =
                pose_before(chosen.empty() ? place_in(scene, more) : boxes[chosen[nth]], config,
                            mount, philox({i, k, 1, 0}, key), philox({i, k, 2, 0}, key),
                            unit_double(pick.x2, pick.x3));
            const Pose sensor = mount ? pose * *mount : pose;
            if (has_room(sensor.translation)) poses.push_back({static_cast<double>(i), pose});
        }
    }
    return poses;
}

}  // namespace sonarsim
