#include "run/preview/object_boxes.h"

#include <algorithm>
#include <utility>

#include "input/scene/copies.h"

namespace sonarsim {

namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t max_boxes = 150;
constexpr std::size_t max_names = 20;
constexpr double max_of_plot = 0.3;  // a larger object is the floor or the walls
constexpr Rgb box_colour{230, 230, 230};

/// The box of each of Scene::instances at a pose, world.
std::vector<AlignedBox3d> boxes_at(const Assembly& assembly, std::uint32_t pose) {
    const Scene& scene = assembly.scene;
    std::vector<AlignedBox3d> boxes = boxes_of_instances(scene);
    const std::vector<Pose> poses = body_poses(assembly, assembly.trajectory[pose].t_s);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        for (const Eigen::Vector3f& vertex : scene.bodies[k].vertices) {
            boxes[scene.bodies[k].instance].extend(poses[k].rotation * vertex.cast<double>() +
                                                   poses[k].translation);
        }
    }
    return boxes;
}

/// The box in pixels of the tile.
AlignedBox2d box_in_plan(const PlaneFrame& frame, const AlignedBox3d& box) {
    AlignedBox2d pixels(frame.pixel(box.min().head<2>()));
    return pixels.extend(frame.pixel(box.max().head<2>()));
}

/// The box of a name on the right or on the left of its object.
AlignedBox2d box_of_name(const AlignedBox2d& object, int width, bool left) {
    constexpr double height = 11.0;  // seven pixels and a dark outline
    constexpr double gap = 4.0;
    const double x = left ? object.min().x() - gap - width : object.max().x() + gap;
    const Vector2d low(x, object.center().y() - 0.5 * height);
    return {low, low + Vector2d(width, height)};
}

void draw_box(Picture& tile, const AlignedBox2d& box) {
    using Box = AlignedBox2d;
    constexpr float share = 0.55F;
    const std::pair<Box::CornerType, Box::CornerType> sides[] = {
        {Box::BottomLeft, Box::BottomRight},
        {Box::BottomRight, Box::TopRight},
        {Box::TopRight, Box::TopLeft},
        {Box::TopLeft, Box::BottomLeft}};
    for (const auto& side : sides)
        draw_line(tile, box.corner(side.first), box.corner(side.second), box_colour, share);
}

}  // namespace

std::vector<ObjectBox> object_boxes(const Assembly& assembly, std::uint32_t pose) {
    const std::vector<AlignedBox3d> instances = boxes_at(assembly, pose);
    const SceneObjects& objects = assembly.objects;
    // Objects are grouped only for a mission with labels or classes.
    const bool is_grouped = objects.object_of_instance.size() == instances.size();
    std::vector<ObjectBox> boxes(is_grouped ? objects.objects.size() : instances.size());
    for (std::size_t k = 0; k < boxes.size(); ++k)
        boxes[k].name = is_grouped ? objects.objects[k].name : assembly.scene.instances[k];
    for (std::size_t k = 0; k < instances.size(); ++k) {
        const std::size_t own = is_grouped ? objects.object_of_instance[k] : k;
        if (is_grouped && objects.is_background(static_cast<std::uint32_t>(own))) continue;
        if (!instances[k].isEmpty()) boxes[own].box.extend(instances[k]);
    }
    std::erase_if(boxes, [](const ObjectBox& one) { return one.box.isEmpty(); });
    return boxes;
}

std::vector<AlignedBox2d> draw_objects(Picture& tile, const PlaneFrame& frame,
                                       const std::vector<ObjectBox>& objects) {
    const Vector2d corner(frame.left, frame.top);
    const AlignedBox2d plot(corner, corner + Vector2d(frame.plot_width, frame.plot_height));
    std::vector<std::pair<AlignedBox2d, const ObjectBox*>> shown;
    for (const ObjectBox& object : objects) {
        const AlignedBox2d box = box_in_plan(frame, object.box);
        if (plot.contains(box.center()) && box.volume() < max_of_plot * plot.volume())
            shown.emplace_back(box, &object);
    }
    std::ranges::stable_sort(shown, {}, [](const auto& one) { return -one.first.volume(); });
    shown.resize(std::min(shown.size(), max_boxes));
    for (const auto& one : shown)
        draw_box(tile, one.first);
    std::vector<AlignedBox2d> taken;
    for (const auto& one : shown) {
        for (const bool left : {false, true}) {
            const AlignedBox2d name = box_of_name(one.first, text_width(one.second->name), left);
            const auto overlaps = [&](const AlignedBox2d& other) { return name.intersects(other); };
            if (taken.size() == max_names || !plot.contains(name) ||
                std::ranges::any_of(taken, overlaps))
                continue;
            taken.push_back(name);
            const Vector2d at = name.center();
            outlined_label(tile, static_cast<int>(at.x()), static_cast<int>(at.y()),
                           one.second->name, Align::middle, ink);
            break;
        }
    }
    return taken;
}

}  // namespace sonarsim
