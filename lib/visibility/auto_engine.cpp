#include "visibility/auto_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "visibility/image_change.h"
#include "visibility/rays/rays_engine.h"
#include "visibility/view_parts.h"

namespace sonarsim {

namespace {

// With fewer triangles in the whole scene the slices were faster at every goal, or rays missed the
// goal.
constexpr std::size_t few_triangles = 20'000;

// With more of them the engines see only parts of a view before the choice. Chosen: fine slices of
// all beams over eight million triangles of rough ground took more than 20 GB and 100 s.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

// Rays whose estimated error is this multiple of the goal are not compared with slices. Chosen: the
// estimate of rays over rough ground was 3.4 times the goal.
constexpr double near_goal = 2.0;

// Per sample, rays take 0.8 to 1.4 times as long as slices on the tank, the wreck and the sea
// floor, so rays with half of the samples are faster.
constexpr double most_samples_share = 0.5;

// Goals to try rays with, as multiples of the view's goal. The density of rays was fitted to rough
// floors at grazing incidence; over a smooth floor their error is a third of the goal.
constexpr std::array goal_factors{2.0, 1.8, 1.6, 1.4, 1.2, 1.0};

// The images that rays are compared with are made for this share of the goal, so that their own
// error takes little of the rays' allowance.
constexpr double share_for_slices = 1.0 / 3.0;

/// A view traced by rays at a goal of their own, and the error of its image.
struct RaysView {
    View view;
    double goal;
    double error;
};

/// The slices' image from a probe.
struct SlicesImage {
    std::vector<Sight> parts;   ///< the view, or parts of it
    std::vector<double> image;  ///< part after part
    double error = 0.0;         ///< the worst part's
    double samples = 0.0;       ///< at the goal of the view
};

View with_goal(View view, double relative_l1) {
    view.relative_l1 = relative_l1;
    return view;
}

void append(std::vector<double>& image, const std::vector<double>& part) {
    image.insert(image.end(), part.begin(), part.end());
}

/// The views that the engines see of a probe.
std::vector<Sight> sights_of(const Scene& scene, const Probe& probe) {
    if (scene.triangles.size() > many_triangles) return parts_of(probe.view, probe.T_world_sensor);
    return {{probe.view, probe.T_world_sensor}};
}

/// True if a view's rays are worth a comparison with slices. Over many triangles, which make fine
/// slices expensive, their own estimate has to be near the goal.
bool may_do_by_rays(const Scene& scene, const View& view, std::span<const Probe> probes,
                    const VisibilityEngine& rays) {
    if (scene.triangles.size() <= many_triangles) return true;
    return std::ranges::all_of(probes, [&](const Probe& probe) {
        return probe.view != view ||
               std::ranges::all_of(sights_of(scene, probe), [&](const Sight& sight) {
                   return rays.visible_surface(sight.view, sight.T_world_sensor).estimated_l1 <=
                          near_goal * view.relative_l1;
               });
    });
}

std::vector<SlicesImage> slices_images(const Scene& scene, const View& view,
                                       std::span<const Probe> probes,
                                       const VisibilityEngine& slices) {
    std::vector<SlicesImage> images;
    for (const Probe& probe : probes) {
        if (probe.view != view) continue;
        SlicesImage& by_slices = images.emplace_back();
        by_slices.parts = sights_of(scene, probe);
        for (const auto& [part, pose] : by_slices.parts) {
            const View fine = with_goal(part, share_for_slices * view.relative_l1);
            const auto samples = slices.visible_surface(part, pose).items.size();
            const Samples seen = slices.visible_surface(fine, pose);
            append(by_slices.image, mean_echoes(scene, part, seen));
            by_slices.error = std::max(by_slices.error, seen.estimated_l1);
            by_slices.samples += static_cast<double>(samples);
        }
        by_slices.samples = std::max(by_slices.samples, 1.0);
    }
    return images;
}

RaysTrial try_goal(const Scene& scene, const View& view, double goal,
                   std::span<const SlicesImage> by_slices, const VisibilityEngine& rays) {
    RaysTrial worst{.goal = goal};
    for (const SlicesImage& known : by_slices) {
        std::vector<double> image;
        double samples = 0.0;
        for (const auto& [part, pose] : known.parts) {
            const Samples seen = rays.visible_surface(with_goal(part, goal), pose);
            append(image, mean_echoes(scene, part, seen));
            samples += static_cast<double>(seen.items.size());
        }
        worst.error = std::max(worst.error, image_change(image, known.image) + known.error);
        worst.samples_share = std::max(worst.samples_share, samples / known.samples);
        if (worst.error > view.relative_l1) break;
    }
    return worst;
}

class AutoEngine final : public VisibilityEngine {
  public:
    AutoEngine(std::unique_ptr<VisibilityEngine> slices, std::unique_ptr<VisibilityEngine> rays,
               std::vector<RaysView> rays_views)
        : slices_(std::move(slices)), rays_(std::move(rays)), rays_views_(std::move(rays_views)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const auto by_rays = std::ranges::find(rays_views_, view, &RaysView::view);
        if (by_rays == rays_views_.end()) return slices_->visible_surface(view, T_world_sensor);
        Samples samples = rays_->visible_surface(with_goal(view, by_rays->goal), T_world_sensor);
        // Rays that the mission asks for have no trial.
        if (!std::isnan(by_rays->error)) samples.estimated_l1 = by_rays->error;
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        slices_->intersect(T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return slices_->covered_bins(view, T_world_sensor);
    }

  private:
    std::unique_ptr<VisibilityEngine> slices_;
    std::unique_ptr<VisibilityEngine> rays_;
    std::vector<RaysView> rays_views_;
};

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
                                                   std::span<const Probe> probes, bool coverage) {
    return make_auto_engine(scene, Caster(scene), options, probes, coverage);
}

std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const Caster& caster,
                                                   const SlicesOptions& options,
                                                   std::span<const Probe> probes, bool coverage) {
    if (!scene.bodies.empty() || !scene.copies.empty())
        return make_rays_engine(scene, caster, coverage);
    auto slices = make_slices_engine(scene, caster, options, coverage);
    const bool few = scene.triangles.size() < few_triangles;
    if (few && std::ranges::all_of(probes, [](const Probe& p) { return p.rays_goal == 0.0; }))
        return slices;
    auto rays = make_rays_engine(scene, caster, false);
    std::vector<View> tried;
    std::vector<RaysView> better;
    for (const Probe& probe : probes) {
        if (std::ranges::find(tried, probe.view) != tried.end()) continue;
        tried.push_back(probe.view);
        double goal = 0.0;
        for (const Probe& other : probes) {
            if (other.view != probe.view || other.rays_goal == 0.0) continue;
            goal = goal == 0.0 ? other.rays_goal : std::min(goal, other.rays_goal);
        }
        if (goal > 0.0) {
            better.push_back({probe.view, goal, std::numeric_limits<double>::quiet_NaN()});
            continue;
        }
        if (few || !may_do_by_rays(scene, probe.view, probes, *rays)) continue;
        const RaysTrial trial = try_rays(scene, probe.view, probes, *rays, *slices);
        if (rays_are_better(trial, probe.view))
            better.push_back({probe.view, trial.goal, trial.error});
    }
    if (better.empty()) return slices;
    return std::make_unique<AutoEngine>(std::move(slices), std::move(rays), std::move(better));
}

}  // namespace sonarsim
