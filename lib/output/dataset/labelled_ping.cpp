#include "output/dataset/labelled_ping.h"

#include "input/scene/copies.h"
#include "input/scene/mesh_topology.h"
#include "simulate/labels/silhouette.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;

ObjectSphere sphere_around(const Eigen::AlignedBox3d& box, double area_m2) {
    return {box.center(), 0.5 * box.diagonal().norm(), area_m2};
}

/// The surface of an object at rest, world; its area without that of copies.
struct StillSurface {
    Eigen::AlignedBox3d box;
    double area_m2 = 0.0;
};

std::vector<StillSurface> still_surfaces(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    std::vector<StillSurface> surfaces(objects.objects.size());
    for (std::size_t k = 0; k < scene.triangles.size(); ++k) {
        StillSurface& surface = surfaces[objects.object_of(scene.triangle_instance[k])];
        for (const std::uint32_t vertex : scene.triangles[k])
            surface.box.extend(scene.origin + scene.vertices[vertex].cast<double>());
        surface.area_m2 += 0.5 * cross_of(scene.vertices, scene.triangles[k]).norm();
    }
    for (const MeshCopy& copy : scene.copies) {
        Eigen::AlignedBox3d& box = surfaces[objects.object_of(copy.instance)].box;
        for (const Eigen::Vector3f& vertex : scene.shared_meshes[copy.mesh].vertices)
            box.extend(copy.T_world_mesh * vertex.cast<double>());
    }
    return surfaces;
}

AnnotatedObjects annotated_objects(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    const std::vector<StillSurface> surfaces = still_surfaces(assembly);
    AnnotatedObjects annotated;
    for (const StillSurface& surface : surfaces)
        annotated.surface.extend(surface.box);
    if (!scene.bodies.empty()) annotated.surface.setEmpty();
    for (std::uint32_t k = 0; k < surfaces.size(); ++k) {
        if (!objects.is_background(k) && !surfaces[k].box.isEmpty())
            annotated.still.push_back(sphere_around(surfaces[k].box, surfaces[k].area_m2));
    }
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        if (objects.is_background(objects.object_of(scene.bodies[k].instance))) continue;
        annotated.moving.push_back({k, sphere_around(box_of(scene.bodies[k].vertices), 0.0)});
    }
    return annotated;
}

/// The spheres of all annotated objects in the world at the time `t_s` of the trajectory.
std::vector<ObjectSphere> spheres_at(const AnnotatedObjects& objects, const Assembly& assembly,
                                     double t_s) {
    std::vector<ObjectSphere> spheres = objects.still;
    if (objects.moving.empty()) return spheres;
    const std::vector<Pose> T_world_body = body_poses(assembly, t_s);
    for (const AnnotatedObjects::Moving& one : objects.moving) {
        const Pose& T = T_world_body[one.body];
        spheres.push_back({T.rotation * one.sphere.centre + T.translation, one.sphere.radius_m});
    }
    return spheres;
}

/// The ids without those of background.
Ids without_background(Ids ids, const SceneObjects& objects) {
    for (std::uint16_t& id : ids) {
        if (id != 0 && objects.is_background(id - 1U)) id = 0;
    }
    return ids;
}

/// The outlines of a ping; in a record, which is drawn in its picture, the bodies.
Ids find_outlines(const LabelPlan& plan, const PingSettings& settings, const PingLabels& labels) {
    const EchoModelInfo& info = settings.model->info;
    const MaskFrame frame = frame_of(settings.view, info.cell);
    std::vector<float> noise = info.mean_noise;
    for (std::size_t i = 0; i < noise.size(); ++i)
        noise[i] = info.echo_gain.empty() ? 0.0F : noise[i] / info.echo_gain[i];
    // Weak parts of the visible body count, 1 dB above what is there without them; of multipath,
    // such as the foot of a wall, what outshines all else.
    constexpr float body_ratio = 0.25F;
    Ids found = find_bodies({frame, labels.visible_object, labels.visible_echo, labels.whole_echo},
                            noise, body_ratio);
    const Ids bright =
        find_bodies({frame, labels.own_object, labels.own_echo, labels.whole_echo}, noise, 1.0F);
    add_bright(frame, bright, found);
    drop_mirror_images(frame, labels.visible_object, found);
    return plan.objects ? outlined(frame, found) : found;
}

}  // namespace

std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const StillSurface& surface : still_surfaces(assembly))
        boxes.push_back(surface.box);
    for (const Body& body : assembly.scene.bodies)
        boxes[assembly.objects.object_of(body.instance)].setEmpty();
    return boxes;
}

std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    std::vector<int> parts(objects.objects.size(), 0);
    for (const std::uint32_t object : objects.object_of_instance)
        ++parts[object];
    std::vector<std::optional<MovingObject>> moving(parts.size());
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const std::uint32_t object = objects.object_of(scene.bodies[k].instance);
        if (parts[object] > 1) continue;
        moving[object] = {k, box_of(scene.bodies[k].vertices)};
    }
    return moving;
}

bool is_listed(const Mission& mission, Label label) {
    return std::ranges::find(mission.output.labels, label) != mission.output.labels.end();
}

LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar) {
    const auto listed = [&](Label label) { return is_listed(mission, label); };
    const bool has_images = kind_of(sonar.config.kind).has_images;
    const bool objects = listed(Label::objects);
    const bool shares = listed(Label::share) || listed(Label::second) || listed(Label::multipath);
    const OutputConfig& output = mission.output;
    const MaskKind mask = mission.labels.mask;
    const bool only_objects = has_images && output.labels == std::vector{Label::objects};
    LabelPlan plan;
    plan.on = !output.labels.empty();
    plan.request = {.objects = objects || listed(Label::instance) || shares,
                    .only_objects = only_objects,
                    .shares = shares,
                    .classes = listed(Label::class_name),
                    .materials = listed(Label::material),
                    .elevation = listed(Label::elevation),
                    .shadow = listed(Label::shadow),
                    .height = listed(Label::height),
                    .outlines = objects && mask != MaskKind::echo,
                    .annotations = objects,
                    .bottom = assembly.bottom.get()};
    plan.mask = mask;
    plan.has_shadow = shadow_ids(assembly.objects);
    plan.objects = has_images && objects;
    plan.fan_objects = plan.objects && output.fan;
    if (plan.fan_objects || (has_images && listed(Label::fan)))
        plan.fan = assembly.fans->bins(sonar);
    if (objects || listed(Label::shadow)) plan.annotated = annotated_objects(assembly);
    if (listed(Label::shadow))
        plan.triangles = std::make_shared<const SceneClusters>(assembly.scene);
    return plan;
}

LabelledPing label_for_writers(const LabelPlan& plan, const Assembly& assembly, const Sonar& sonar,
                               const VisibilityEngine& engine, const TracedPing& traced,
                               const Ping& ping, double t_s) {
    LabelRequest request = plan.request;
    const std::vector<ObjectSphere> spheres = spheres_at(plan.annotated, assembly, t_s);
    request.annotated = spheres;
    request.surface = &plan.annotated.surface;
    request.triangles = plan.triangles.get();
    LabelledPing out;
    out.bins =
        label_ping(traced, sonar.settings, assembly.scene, assembly.objects, engine, request);
    out.fan_bins = plan.fan.get();
    if (request.outlines) out.bins.silhouette = find_outlines(plan, sonar.settings, out.bins);
    if (!plan.objects) return out;
    Ids mask = without_background(out.bins.facts(), assembly.objects);
    if (plan.mask != MaskKind::echo && std::ranges::count(plan.has_shadow, 1) > 0) {
        const MaskFrame frame = frame_of(sonar.settings.view, sonar.settings.model->info.cell);
        const Ids shadow = visible_shadows(level_map(sonar, out.bins, ping), plan.has_shadow,
                                           background_ids(assembly.objects));
        mask = with_shadows(frame, mask, shadow, plan.has_shadow);
    }
    out.polar = object_masks(mask, out.bins.range_bins);
    std::span<const PixelBox> fan_boxes;
    if (plan.fan_objects) {
        out.fan = object_masks(fan_values(plan.fan->by_column, mask, std::uint16_t{0}),
                               plan.fan->frame.height);
        fan_boxes = plan.fan->boxes;
    }
    out.visible = visible_objects(sonar, assembly.objects, traced, out.bins, ping, fan_boxes);
    return out;
}

}  // namespace sonarsim
