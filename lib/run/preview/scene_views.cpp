#include <algorithm>
#include <utility>

#include "core/units.h"
#include "input/scene/copies.h"
#include "run/preview/preview.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Rgb path_colour{255, 255, 255};

Vector2d flat(const Vector3d& p) {
    return p.head<2>();
}

/// Draws faint lines from the sonar to the edge of its view, and the edge.
void draw_beam(Picture& tile, const PlaneFrame& frame, const BeamOutline& beam) {
    constexpr float ray_share = 0.12F;
    const Vector2d from = frame.pixel(flat(beam.origin));
    for (std::size_t k = 0; k < beam.ends.size(); ++k) {
        const Vector2d here = frame.pixel(flat(beam.ends[k]));
        const Vector2d next = frame.pixel(flat(beam.ends[(k + 1) % beam.ends.size()]));
        draw_line(tile, from, here, beam.colour, ray_share);
        draw_line(tile, here, next, beam.colour);
    }
}

/// Draws the heights in dim colours with light from the north-west.
void draw_heights(Picture& tile, const PlaneFrame& frame, const std::vector<float>& heights) {
    std::vector<float> known;
    std::ranges::copy_if(heights, std::back_inserter(known),
                         [](float z) { return !std::isnan(z); });
    if (known.empty()) return;
    std::ranges::sort(known);
    const float low = known[known.size() / 50];
    const float high = std::max(known[known.size() - 1 - known.size() / 50], low + 1e-3F);
    const auto width = static_cast<std::size_t>(frame.plot_width);
    for (std::size_t k = 0; k < heights.size(); ++k) {
        if (std::isnan(heights[k])) continue;
        const auto neighbour = [&](std::size_t other) {
            const bool usable = other < heights.size() && !std::isnan(heights[other]);
            return usable ? heights[other] : heights[k];
        };
        const float rise = (heights[k] - neighbour(k % width > 0 ? k - 1 : k) + heights[k] -
                            neighbour(k - width)) /
                           static_cast<float>(frame.pixel_m);
        const float light = std::clamp(0.55F + 0.25F * rise, 0.3F, 0.8F);
        const Rgb full = blend(sea_colours, (heights[k] - low) / (high - low));
        const Rgb ends[] = {backdrop, full};
        tile.row(static_cast<int>(k / width))[frame.left + k % width] = blend(ends, light);
    }
}

Vector2d heading_of(const Pose& T_world_vehicle) {
    const Vector3d bow = T_world_vehicle.rotation * Vector3d::UnitX();
    // A vehicle that points straight up or down has no heading; any axis will do.
    return bow.head<2>().norm() < 1e-6 ? Vector2d(1.0, 0.0) : Vector2d(bow.head<2>().normalized());
}

/// The area that the plan shows.
AlignedBox2d plan_box(const Moment& moment) {
    AlignedBox2d box;
    for (const TimedPose& pose : moment.assembly.trajectory)
        box.extend(flat(pose.T_world_vehicle.translation));
    for (const BeamOutline& beam : moment.beams) {
        for (const Vector3d& end : beam.ends)
            box.extend(flat(end));
    }
    const double margin_m = std::max(0.5, 0.1 * box.sizes().maxCoeff());
    box = {box.min().array() - margin_m, box.max().array() + margin_m};
    // The plan shows all of the scene if it is not much larger.
    const Scene& scene = moment.assembly.scene;
    const AlignedBox2d all(flat(scene.bounds_min), flat(scene.bounds_max));
    const bool fits = (all.max() - all.min()).maxCoeff() < 2.0 * box.sizes().maxCoeff();
    return fits ? box.merged(all) : box;
}

constexpr int edge_steps = 48;  // rays along each side, or around a cone

std::vector<Ray> rays_around(const View& view) {
    std::vector<Ray> rays;
    const auto add = [&](const Vector3d& direction) {
        rays.push_back({Eigen::Vector3f::Zero(), direction.cast<float>().normalized()});
    };
    const double azimuth = 0.5 * view.azimuth_rad;
    const double elevation = 0.5 * view.elevation_rad;
    if (view.shape == ViewShape::cone) {
        for (int k = 0; k < edge_steps; ++k)
            add(direction_off_boresight(azimuth, 2.0 * pi * k / edge_steps));
        return rays;
    }
    const auto at = [&](double across, double up) {
        add(direction_of(azimuth * across, elevation * up));
    };
    for (int side = 0; side < 4; ++side) {
        for (int k = 0; k < edge_steps; ++k) {
            const double along = 2.0 * k / edge_steps - 1.0;
            if (side == 0) at(along, 1.0);
            if (side == 1) at(1.0, -along);
            if (side == 2) at(-along, -1.0);
            if (side == 3) at(-1.0, along);
        }
    }
    return rays;
}

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
    const Box::CornerType once_around[] = {Box::BottomLeft, Box::BottomRight, Box::TopRight,
                                           Box::TopLeft, Box::BottomLeft};
    for (int k = 0; k < 4; ++k) {
        draw_line(tile, box.corner(once_around[k]), box.corner(once_around[k + 1]), box_colour,
                  share);
    }
}

}  // namespace

BeamOutline beam_outline(const Sonar& sonar, const VisibilityEngine& engine,
                         const Pose& T_world_sensor, Rgb colour) {
    const View& view = sonar.settings.view;
    const std::vector<Ray> rays = rays_around(view);
    std::vector<Intersection> met(rays.size());
    engine.intersect(T_world_sensor, rays, met);
    BeamOutline outline{T_world_sensor.translation, {}, colour};
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const double range = std::min<double>(met[k].distance_m, view.range_max_m);
        outline.ends.push_back(T_world_sensor.translation +
                               T_world_sensor.rotation *
                                   (range * rays[k].direction.cast<double>()));
    }
    return outline;
}

std::vector<float> heights_below(const VisibilityEngine& engine, const Vector3d& vehicle,
                                 const PlaneFrame& frame) {
    std::vector<Ray> rays;
    for (int row = 0; row < frame.plot_height; ++row) {
        for (int column = 0; column < frame.plot_width; ++column) {
            const Vector2d at = frame.metres(column, row) - flat(vehicle);
            rays.push_back(
                {Vector3d(at.x(), at.y(), 0.0).cast<float>(), -Eigen::Vector3f::UnitZ()});
        }
    }
    std::vector<Intersection> met(rays.size());
    engine.intersect({Eigen::Quaterniond::Identity(), vehicle}, rays, met);
    std::vector<float> heights(met.size(), std::nanf(""));
    for (std::size_t k = 0; k < met.size(); ++k) {
        if (std::isfinite(met[k].distance_m))
            heights[k] = static_cast<float>(vehicle.z()) - met[k].distance_m;
    }
    return heights;
}

Picture draw_plan(const Moment& moment, int width, int height) {
    const Trajectory& trajectory = moment.assembly.trajectory;
    const AlignedBox2d box = plan_box(moment);
    const PlaneFrame frame = plane_frame(width, height, box.min(), box.max());
    Picture tile(width, height, backdrop);
    const Pose& now = trajectory[moment.pose].T_world_vehicle;
    draw_heights(tile, frame, heights_below(moment.engine, now.translation, frame));
    for (std::size_t k = 1; k < trajectory.size(); ++k) {
        draw_line(tile, frame.pixel(flat(trajectory[k - 1].T_world_vehicle.translation)),
                  frame.pixel(flat(trajectory[k].T_world_vehicle.translation)), path_colour, 0.7F);
    }
    for (const BeamOutline& beam : moment.beams)
        draw_beam(tile, frame, beam);
    const Vector2d here = frame.pixel(flat(now.translation));
    const Vector2d ahead = heading_of(now);
    draw_line(tile, here, here + 18.0 * Vector2d(ahead.x(), -ahead.y()), path_colour);
    draw_dot(tile, here, 2, path_colour);
    draw_objects(tile, frame, object_boxes(moment.assembly, moment.pose));
    draw_axes(tile, frame);
    return tile;
}

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
    const Vector2d corner(frame.left, 0.0);
    const AlignedBox2d plot(corner, corner + Vector2d(frame.plot_width, frame.plot_height));
    std::vector<std::pair<AlignedBox2d, const ObjectBox*>> shown;
    for (const ObjectBox& object : objects) {
        AlignedBox2d box(frame.pixel(flat(object.box.min())));
        box.extend(frame.pixel(flat(object.box.max())));
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
