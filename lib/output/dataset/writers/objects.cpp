#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "output/dataset/writer.h"

namespace sonarsim {

namespace {

/// The box around a whole object along the axes of a frame, placed in the sensor's frame.
Json placed_box_json(const Eigen::AlignedBox3d& box, const Pose& T_world_frame,
                     const Pose& T_world_sensor) {
    if (box.isEmpty()) return nullptr;
    const Eigen::Vector3d centre =
        T_world_frame.rotation * box.center() + T_world_frame.translation;
    const Eigen::Quaterniond to_sensor = T_world_sensor.rotation.conjugate();
    Json json = describe_pose(
        {to_sensor * T_world_frame.rotation, to_sensor * (centre - T_world_sensor.translation)});
    json["size_m"] = describe_vector(box.sizes());
    return json;
}

/// The visible footprints, which overlap the edges of surface, within a box around the object.
Eigen::AlignedBox3f within(const Eigen::AlignedBox3f& seen, const Eigen::AlignedBox3d& box,
                           const Pose& T_world_frame, const Pose& T_world_sensor) {
    if (box.isEmpty()) return seen;
    constexpr double rounding_m = 1e-3;  // floats, 10 km from the scene's centre
    const Eigen::Affine3d to_sensor = affine(T_world_sensor).inverse(Eigen::Isometry);
    Eigen::AlignedBox3d whole = box.transformed(to_sensor * affine(T_world_frame));
    whole.min().array() -= rounding_m;
    whole.max().array() += rounding_m;
    return seen.intersection(whole.cast<float>());
}

/// The mask of an object in a list sorted by id; null for none.
const ObjectMask* mask_of(const std::vector<ObjectMask>& masks, std::uint32_t id) {
    const auto found = std::ranges::lower_bound(masks, id, {}, &ObjectMask::id);
    return found != masks.end() && found->id == id ? &*found : nullptr;
}

/// The boxes of the objects, indexed by object.
struct ObjectBoxes {
    std::vector<Eigen::AlignedBox3d> still;  ///< world
    std::vector<std::optional<MovingObject>> moving;
};

/// True if its bins touch the first or last range bin or an edge beam: the view cuts it off.
bool is_clipped(const View& view, const ObjectMask& mask) {
    const bool at_side = mask.left == 0 || mask.right == view.beams;
    return mask.top == 0 || mask.bottom == view.range_bins || (at_side && !is_full_turn(view));
}

Json shadow_json(const ObjectInPing& visible) {
    const BinBox& box = visible.shadow;
    return {{"box_bins",
             {{"range", {box.first_bin, box.last_bin + 1}},
              {"beam", {box.first_line, box.last_line + 1}}}},
            {"area_bins", visible.shadow_bins},
            {"contrast_db", number_or_null(visible.shadow_contrast_db)}};
}

/// Null for an object that lies between the pixels.
Json fan_json(const ObjectInPing& visible, const ObjectMask* mask) {
    if (!mask) return nullptr;
    Json json = {{"box_px", describe_box({mask->left, mask->right, mask->top, mask->bottom})},
                 {"area_px", mask->area}};
    if (!visible.shadow_in_fan.is_empty())
        json["shadow_box_px"] = describe_box(visible.shadow_in_fan);
    json["mask"] = coco_counts(mask->runs);
    return json;
}

/// The facts of an object in a ping.
Json visible_json(const WriterContext& context, const ObjectBoxes& boxes,
                  const ObjectInPing& visible, const FinishedPing& finished,
                  std::span<const Pose> T_world_body) {
    const SceneObjects& objects = context.assembly.objects;
    const SceneObjects::Object& object = objects.objects[visible.id - 1];
    const ObjectMask& mask = *mask_of(finished.labels->polar, visible.id);
    Json json = {
        {"id", visible.id},
        {"name", object.name},
        {"class", objects.classes[object.class_index]},
        {"box_bins", {{"range", {mask.top, mask.bottom}}, {"beam", {mask.left, mask.right}}}},
        {"area_bins", mask.area},
        {"level", visible.level},
        {"level_around", number_or_null(visible.surrounding_level)},
        {"range_m", visible.range_m},
        {"azimuth_rad", number_or_null(visible.azimuth_rad)}};
    const Pose& T_world_sensor = finished.traced.T_world_sensor;
    const bool at_true_places =
        finished.traced.motion.is_still() && !context.assembly.scene.sound_profile;
    const auto add_boxes = [&](const Eigen::AlignedBox3d& box, const Pose& T_world_frame) {
        const Eigen::AlignedBox3f& seen = visible.box_sensor_m;
        json["seen_box_sensor_m"] =
            describe_box(at_true_places ? within(seen, box, T_world_frame, T_world_sensor) : seen);
        json["box_sensor"] = placed_box_json(box, T_world_frame, T_world_sensor);
    };
    if (const std::optional<MovingObject>& moving = boxes.moving[visible.id - 1]) {
        json["T_world_object"] = describe_pose(T_world_body[moving->body]);
        add_boxes(moving->box, T_world_body[moving->body]);
    } else {
        add_boxes(boxes.still[visible.id - 1], {});
    }
    if (!finished.labels->bins.visible_share.empty())
        json["visible_share"] = finished.labels->bins.visible_share[visible.id - 1];
    json["contrast_db"] = number_or_null(visible.contrast_db);
    if (!visible.shadow.is_empty()) json["shadow"] = shadow_json(visible);
    json["clipped"] = is_clipped(context.sonar().settings.view, mask);
    json["mask"] = coco_counts(mask.runs);
    if (finished.labels->fan_bins) {
        json["fan"] = fan_json(visible, mask_of(finished.labels->fan, visible.id));
    }
    return json;
}

}  // namespace

Writer objects_writer(const WriterContext& context) {
    const auto boxes = std::make_shared<const ObjectBoxes>(
        ObjectBoxes{object_boxes(context.assembly), moving_objects(context.assembly)});
    const auto encode = [=](const FinishedPing& finished) {
        const Assembly& assembly = context.assembly;
        const std::vector<Pose> T_world_body =
            body_poses(assembly, assembly.trajectory[finished.id.pose].t_s);
        std::vector<Json> objects;
        for (const ObjectInPing& visible : finished.labels->visible)
            objects.push_back(visible_json(context, *boxes, visible, finished, T_world_body));
        return objects_text({{"ping", finished.id.pose}}, objects);
    };
    return {.per_ping = PingFile{"objects", ".json"}, .encode = encode};
}

}  // namespace sonarsim
