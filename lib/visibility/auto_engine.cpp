#include "visibility/auto_engine.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "visibility/dense_rays.h"
#include "visibility/engine_by_view.h"
#include "visibility/image_change.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim {

namespace {

// With fewer triangles in the whole scene the slices were faster at every goal, or rays missed the
// goal.
constexpr std::size_t few_triangles = 20'000;

// A sample of the rays takes 0.8 to 1.4 times as long as one of the slices on the tank, the wreck
// and the sea floor, so rays with half of the samples are faster.
constexpr double most_samples_share = 0.5;

// Goals to try rays with, as multiples of the view's goal. The density of rays was fitted to rough
// floors at grazing incidence; over a smooth floor their error is a third of the goal.
constexpr std::array goal_factors{2.0, 1.8, 1.6, 1.4, 1.2, 1.0};

// The images that rays are compared with are made for this share of the goal, so that their own
// error takes little of the rays' allowance.
constexpr double share_for_slices = 1.0 / 3.0;

/// The slices' image from a probe.
struct SlicesImage {
    Pose T_world_sensor;
    std::vector<double> image;
    double error;
    double samples;  ///< at the goal of the view
};

View with_goal(View view, double relative_l1) {
    view.relative_l1 = relative_l1;
    return view;
}

std::vector<SlicesImage> slices_images(const Scene& scene, const View& view,
                                       std::span<const Probe> probes,
                                       const VisibilityEngine& slices) {
    const View fine = with_goal(view, share_for_slices * view.relative_l1);
    std::vector<SlicesImage> images;
    for (const Probe& probe : probes) {
        if (probe.view != view) continue;
        const std::size_t samples = slices.visible_surface(view, probe.T_world_sensor).items.size();
        const Samples seen = slices.visible_surface(fine, probe.T_world_sensor);
        images.push_back({probe.T_world_sensor, mean_echoes(scene, view, seen), seen.estimated_l1,
                          static_cast<double>(std::max<std::size_t>(samples, 1))});
    }
    return images;
}

RaysTrial try_goal(const Scene& scene, const View& view, double goal,
                   std::span<const SlicesImage> by_slices, const VisibilityEngine& rays) {
    RaysTrial worst{.goal = goal};
    for (const SlicesImage& known : by_slices) {
        const Samples seen = rays.visible_surface(with_goal(view, goal), known.T_world_sensor);
        const double change = image_change(mean_echoes(scene, view, seen), known.image);
        worst.error = std::max(worst.error, change + known.error);
        worst.samples_share =
            std::max(worst.samples_share, static_cast<double>(seen.items.size()) / known.samples);
        if (worst.error > view.relative_l1) break;
    }
    return worst;
}

}  // namespace

RaysTrial try_rays(const Scene& scene, const View& view, std::span<const Probe> probes,
                   const VisibilityEngine& rays, const VisibilityEngine& slices) {
    const std::vector<SlicesImage> by_slices = slices_images(scene, view, probes, slices);
    RaysTrial trial;
    for (const double leniency : goal_factors) {
        trial = try_goal(scene, view, leniency * view.relative_l1, by_slices, rays);
        if (trial.error <= view.relative_l1) break;
    }
    return trial;
}

bool rays_are_better(const RaysTrial& trial, const View& view) {
    return trial.error <= view.relative_l1 && trial.samples_share < most_samples_share;
}

std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const SlicesOptions& options,
                                                   std::span<const Probe> probes) {
    return make_auto_engine(scene, Caster(scene), options, probes);
}

std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const Caster& caster,
                                                   const SlicesOptions& options,
                                                   std::span<const Probe> probes) {
    if (!scene.bodies.empty() || !scene.copies.empty()) return make_rays_engine(scene, caster);
    if (scene.triangles.size() > many_triangles)
        return make_dense_rays_engine(scene, caster, probes);
    auto slices = make_slices_engine(scene, caster, options);
    const bool few = scene.triangles.size() < few_triangles;
    if (few && std::ranges::all_of(probes, [](const Probe& p) { return p.rays.goal == 0.0; }))
        return slices;
    const std::shared_ptr<const VisibilityEngine> rays = make_rays_engine(scene, caster);
    const auto trial_slices = without_points(*slices);
    std::vector<View> tried;
    std::vector<EngineOfView> better;
    for (const Probe& probe : probes) {
        if (std::ranges::find(tried, probe.view) != tried.end()) continue;
        tried.push_back(probe.view);
        const RaysNeed need = required_rays(probe.view, probes);
        if (need.goal > 0.0) {
            better.push_back({probe.view, need.goal,
                              make_rays_engine(scene, caster, {.columns = need.columns})});
            continue;
        }
        if (few) continue;
        const RaysTrial trial = try_rays(scene, probe.view, probes, *rays, *trial_slices);
        if (rays_are_better(trial, probe.view))
            better.push_back({probe.view, trial.goal, rays, trial.error});
    }
    if (better.empty()) return slices;
    return make_engine_by_view(std::move(slices), std::move(better));
}

}  // namespace sonarsim
