#include "preview/object_boxes.h"

#include <algorithm>
#include <utility>

#include "scene/copies.h"

namespace sonarsim {

namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t most_boxes = 150;
constexpr std::size_t most_names = 20;
constexpr double most_of_plot = 0.3;  // a larger object is the floor or the walls
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

/// The box of a name next to that of its object: on its right, on its left, above or below.
AlignedBox2d box_of_name(const AlignedBox2d& object, int width, int side) {
    constexpr double height = 11.0;  // seven pixels and a dark outline
    const Vector2d size(width, height);
    const Vector2d middle = object.center() - 0.5 * size;
    Vector2d low = middle;
    if (side == 0) low.x() = object.max().x() + 4.0;
    if (side == 1) low.x() = object.min().x() - 4.0 - size.x();
    if (side == 2) low.y() = object.min().y() - 2.0 - size.y();
    if (side == 3) low.y() = object.max().y() + 2.0;
    return {low, low + size};
}

void draw_box(Drawing& tile, const AlignedBox2d& box) {
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

void draw_objects(Drawing& tile, const PlaneFrame& frame, const std::vector<ObjectBox>& objects) {
    const Vector2d corner(frame.left, frame.top);
    const AlignedBox2d plot(corner, corner + Vector2d(frame.plot_width, frame.plot_height));
    std::vector<std::pair<AlignedBox2d, const ObjectBox*>> shown;
    for (const ObjectBox& object : objects) {
        const AlignedBox2d box = box_in_plan(frame, object.box);
        if (plot.contains(box.center()) && box.volume() < most_of_plot * plot.volume())
            shown.emplace_back(box, &object);
    }
    std::ranges::stable_sort(shown, {}, [](const auto& one) { return -one.first.volume(); });
    shown.resize(std::min(shown.size(), most_boxes));
    for (const auto& one : shown)
        draw_box(tile, one.first);
    std::vector<AlignedBox2d> taken;
    for (const auto& one : shown) {
        const int width = text_width(one.second->name);
        const auto is_free = [&](const AlignedBox2d& name, bool over_objects) {
            const auto overlaps = [&](const AlignedBox2d& other) { return name.intersects(other); };
            const auto hides = [&](const auto& other) { return name.intersects(other.first); };
            return plot.contains(name) && std::ranges::none_of(taken, overlaps) &&
                   (over_objects || std::ranges::none_of(shown, hides));
        };
        // Tries the four sides clear of other objects, then the four sides over them.
        for (int k = 0; k < 8 && taken.size() < most_names; ++k) {
            const AlignedBox2d name = box_of_name(one.first, width, k % 4);
            if (!is_free(name, k >= 4)) continue;
            taken.push_back(name);
            const Vector2d at = name.center();
            tile.texts.push_back({static_cast<int>(at.x()), static_cast<int>(at.y()),
                                  one.second->name, Align::middle, ink, true});
            break;
        }
    }
}

}  // namespace sonarsim
