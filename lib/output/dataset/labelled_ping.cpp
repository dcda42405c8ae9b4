#include "output/dataset/labelled_ping.h"

#include <algorithm>
#include <span>
#include <utility>

#include "simulate/labels/silhouette.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;

/// The bins of a ping. An image in the unit of echoes has all but the receiver's noise: also the
/// water and side lobes.
ExpectedBins expected_bins(const Sonar& sonar, const Scene& scene, const TracedPing& traced,
                           PingLabels& labels) {
    const EchoModelInfo& info = sonar.settings.model->info;
    if (!info.echo_gain.empty()) {
        const Ping clean = form_image(traced, sonar.settings, scene, {}, without_random_terms);
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const auto i = static_cast<int>(k % labels.range_bins);
            const float noise = info.mean_noise.empty() ? 0.0F : info.mean_noise[i];
            const auto beam = static_cast<int>(k / labels.range_bins);
            labels.whole_echo[k] = (clean.at(i, beam) + noise) / info.echo_gain[i];
        }
    }
    return {{labels.beams, labels.range_bins, info.cell},
            labels.own_object,
            labels.own_echo,
            labels.whole_echo};
}

/// The ids without those of background.
Ids without_background(Ids ids, const SceneObjects& objects) {
    for (std::uint16_t& id : ids) {
        if (id != 0 && objects.is_background(id - 1U)) id = 0;
    }
    return ids;
}

/// Finds the silhouettes and returns the masks.
Ids draw_masks(const LabelPlan& plan, const ExpectedBins& expected, PingLabels& labels) {
    Standouts found = find_standouts(expected);
    drop_mirror_images(expected.frame, labels.visible_object, found);
    // Records are tidied in their pictures.
    labels.silhouette =
        plan.objects ? tidied(expected.frame, found.object, found.ratio) : found.object;
    if (!plan.objects || plan.mask != MaskKind::silhouette_and_shadow) return labels.silhouette;
    return with_shadows(expected.frame, labels.silhouette, labels.object_shadow);
}

}  // namespace

bool is_listed(const Mission& mission, Label label) {
    return std::ranges::find(mission.output.labels, label) != mission.output.labels.end();
}

LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar) {
    const auto listed = [&](Label label) { return is_listed(mission, label); };
    const bool has_images = kind_of(sonar.config.kind).has_images;
    const bool objects = listed(Label::objects);
    const bool shares = listed(Label::share) || listed(Label::second) || listed(Label::multipath);
    const OutputConfig& output = mission.output;
    const bool draws = objects && mission.labels.mask != MaskKind::echo;
    const bool only_objects = has_images && !draws && output.labels == std::vector{Label::objects};
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
                    .silhouettes = draws,
                    .annotations = objects,
                    .bottom = assembly.bottom.get()};
    plan.mask = mission.labels.mask;
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
    const Ids mask =
        request.silhouettes
            ? draw_masks(plan, expected_bins(sonar, assembly.scene, traced, out.bins), out.bins)
            : without_background(out.bins.object, assembly.objects);
    if (!plan.objects) return out;
    out.polar = object_masks(mask, out.bins.range_bins);
    std::span<const PixelBox> fan_boxes;
    if (plan.fan_objects) {
        out.fan = object_masks(fan_values(plan.fan->by_column, mask, std::uint16_t{0}),
                               plan.fan->frame.height);
        fan_boxes = plan.fan->boxes;
    }
    out.seen = visible_objects(sonar, assembly.objects, traced, out.bins, ping, fan_boxes);
    return out;
}

}  // namespace sonarsim
