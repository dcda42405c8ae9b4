#include "visibility/dense_rays.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "visibility/rays/rays_engine.h"
#include "visibility/view_parts.h"

namespace sonarsim {

namespace {

// The largest is chosen by the time of a ping of 512 beams over eight million triangles of rock,
// 5 s on one thread.
constexpr std::array densities{1, 2, 4, 6};

// Rays are asked for this share of the goal: over a floor of independent heights in cells of a
// third of a beam their estimate was half of their error.
constexpr double share_of_goal = 0.5;

using Engine = std::shared_ptr<const VisibilityEngine>;

/// A view, the goal that its rays have, and the engine of its density.
struct DenseView {
    View view;
    double goal;
    Engine engine;
};

class DenseRays final : public VisibilityEngine {
  public:
    DenseRays(Engine of_others, std::vector<DenseView> views)
        : of_others_(std::move(of_others)), views_(std::move(views)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const auto known = std::ranges::find(views_, view, &DenseView::view);
        if (known == views_.end()) return of_others_->visible_surface(view, T_world_sensor);
        View asked = view;
        asked.relative_l1 = known->goal;
        return known->engine->visible_surface(asked, T_world_sensor);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        of_others_->intersect(T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return of_others_->covered_bins(view, T_world_sensor);
    }

  private:
    Engine of_others_;
    std::vector<DenseView> views_;
};

}  // namespace

int density_for(const Scene& scene, const Caster& caster, const View& view,
                std::span<const Probe> probes) {
    for (const int density : densities) {
        const auto rays = make_rays_engine(scene, caster, false, density);
        const bool met = std::ranges::all_of(probes, [&](const Probe& probe) {
            return probe.view != view ||
                   std::ranges::all_of(
                       parts_of(view, probe.T_world_sensor), [&](const Sight& part) {
                           return rays->visible_surface(part.view, part.T_world_sensor)
                                      .estimated_l1 <= share_of_goal * view.relative_l1;
                       });
        });
        if (met) return density;
    }
    return densities.back();
}

std::unique_ptr<VisibilityEngine> make_dense_rays_engine(const Scene& scene, const Caster& caster,
                                                         std::span<const Probe> probes,
                                                         bool coverage) {
    std::vector<DenseView> views;
    int most = densities.front();
    for (const Probe& probe : probes) {
        if (std::ranges::find(views, probe.view, &DenseView::view) != views.end()) continue;
        const double goal = required_goal(probe.view, probes);
        const int density = goal > 0.0 ? 1 : density_for(scene, caster, probe.view, probes);
        most = std::max(most, density);
        views.push_back({probe.view, goal > 0.0 ? goal : probe.view.relative_l1,
                         make_rays_engine(scene, caster, false, density)});
    }
    return std::make_unique<DenseRays>(make_rays_engine(scene, caster, coverage, most),
                                       std::move(views));
}

}  // namespace sonarsim
