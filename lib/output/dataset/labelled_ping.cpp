#include "output/dataset/labelled_ping.h"

#include <algorithm>
#include <span>
#include <utility>

#include "simulate/sonar/kinds.h"

namespace sonarsim {

bool is_listed(const Mission& mission, Label label) {
    return std::ranges::find(mission.output.labels, label) != mission.output.labels.end();
}

LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar) {
    const auto listed = [&](Label label) { return is_listed(mission, label); };
    const bool has_images = kind_of(sonar.config.kind).has_images;
    const bool objects = listed(Label::objects);
    const bool shares = listed(Label::share) || listed(Label::second) || listed(Label::multipath);
    const OutputConfig& output = mission.output;
    LabelPlan plan;
    plan.on = !output.labels.empty();
    plan.request = {.objects = objects || listed(Label::instance) || shares,
                    .shares = shares,
                    .classes = listed(Label::class_name),
                    .materials = listed(Label::material),
                    .elevation = listed(Label::elevation),
                    .shadow = listed(Label::shadow),
                    .height = listed(Label::height),
                    .annotations = objects,
                    .bottom = assembly.bottom.get()};
    plan.objects = has_images && objects;
    plan.fan_objects = plan.objects && output.fan;
    if (plan.fan_objects || (has_images && listed(Label::fan)))
        plan.fan = assembly.fans->bins(sonar);
    if (objects || listed(Label::shadow)) plan.annotated = annotated_objects(assembly);
    if (listed(Label::shadow))
        plan.triangles = std::make_shared<const TriangleRuns>(assembly.scene);
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
    if (!plan.objects) return out;
    out.polar = object_masks(out.bins.object, out.bins.range_bins);
    std::span<const PixelBox> fan_boxes;
    if (plan.fan_objects) {
        out.fan = object_masks(fan_values(plan.fan->by_column, out.bins.object, std::uint16_t{0}),
                               plan.fan->frame.height);
        fan_boxes = plan.fan->boxes;
    }
    out.seen = visible_objects(sonar, assembly.objects, traced, out.bins, ping, fan_boxes);
    return out;
}

}  // namespace sonarsim
