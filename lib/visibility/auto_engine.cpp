#include "visibility/auto_engine.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "visibility/image_change.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim {

namespace {

// With fewer triangles in the whole scene the slices were faster at every goal, or rays missed it.
constexpr std::size_t few_triangles = 20'000;

// Per sample, rays take 0.8 to 1.4 times as long as slices on the tank, the wreck and the sea
// floor: with half of the samples they are faster.
constexpr double most_samples_share = 0.5;

/// A view that rays see, and their error.
struct RaysView {
    View view;
    double error;
};

class AutoEngine final : public VisibilityEngine {
  public:
    AutoEngine(std::unique_ptr<VisibilityEngine> slices, std::unique_ptr<VisibilityEngine> rays,
               std::vector<RaysView> rays_views)
        : slices_(std::move(slices)), rays_(std::move(rays)), rays_views_(std::move(rays_views)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const auto by_rays = std::ranges::find(rays_views_, view, &RaysView::view);
        if (by_rays == rays_views_.end()) return slices_->visible_surface(view, T_world_sensor);
        Samples samples = rays_->visible_surface(view, T_world_sensor);
        samples.estimated_l1 = by_rays->error;
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        slices_->intersect(T_world_sensor, rays, intersections);
    }

  private:
    std::unique_ptr<VisibilityEngine> slices_;
    std::unique_ptr<VisibilityEngine> rays_;
    std::vector<RaysView> rays_views_;
};

}  // namespace

RaysTrial try_rays(const Scene& scene, const View& view, std::span<const Probe> probes,
                   const VisibilityEngine& rays, const VisibilityEngine& slices) {
    RaysTrial worst;
    for (const Probe& probe : probes) {
        if (probe.view != view) continue;
        const Samples by_rays = rays.visible_surface(view, probe.T_world_sensor);
        const Samples by_slices = slices.visible_surface(view, probe.T_world_sensor);
        const double error = image_change(scene, view, by_rays, by_slices) + by_slices.estimated_l1;
        const double share = static_cast<double>(by_rays.items.size()) /
                             static_cast<double>(std::max<std::size_t>(by_slices.items.size(), 1));
        worst.error = std::max(worst.error, error);
        worst.samples_share = std::max(worst.samples_share, share);
    }
    return worst;
}

bool rays_are_better(const RaysTrial& trial, const View& view) {
    return trial.error <= view.relative_l1 && trial.samples_share < most_samples_share;
}

std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const SlicesOptions& options,
                                                   std::span<const Probe> probes) {
    if (!scene.bodies.empty() || !scene.copies.empty()) return make_rays_engine(scene);
    auto slices = make_slices_engine(scene, options);
    const bool few = scene.triangles.size() < few_triangles;
    if (few && std::ranges::none_of(probes, &Probe::needs_rays)) return slices;
    auto rays = make_rays_engine(scene);
    std::vector<View> tried;
    std::vector<RaysView> better;
    for (const Probe& probe : probes) {
        if (std::ranges::find(tried, probe.view) != tried.end()) continue;
        tried.push_back(probe.view);
        if (std::ranges::any_of(probes, [&](const Probe& other) {
                return other.view == probe.view && other.needs_rays;
            })) {
            better.push_back({probe.view, std::numeric_limits<double>::quiet_NaN()});
            continue;
        }
        if (few) continue;
        const RaysTrial trial = try_rays(scene, probe.view, probes, *rays, *slices);
        if (rays_are_better(trial, probe.view)) better.push_back({probe.view, trial.error});
    }
    if (better.empty()) return slices;
    return std::make_unique<AutoEngine>(std::move(slices), std::move(rays), std::move(better));
}

}  // namespace sonarsim
