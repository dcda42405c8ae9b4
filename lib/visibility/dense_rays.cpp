#include "visibility/dense_rays.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "visibility/engine_by_view.h"
#include "visibility/image_change.h"
#include "visibility/rays/rays_engine.h"
#include "visibility/view_parts.h"

namespace sonarsim {

namespace {

// The largest is chosen by the time of a ping of 512 beams over eight million triangles of rock,
// 5 s on one thread.
constexpr std::array densities{1, 2, 4, 6};

/// The image of a part of a view by the densest rays.
struct DensestImage {
    Sight part;
    std::vector<double> image;
    double error;
};

std::vector<DensestImage> densest_images(const Scene& scene, const Caster& caster, const View& view,
                                         std::span<const Probe> probes) {
    const auto densest = make_rays_engine(scene, caster, {densities.back()});
    std::vector<DensestImage> out;
    for (const Probe& probe : probes) {
        if (probe.view != view) continue;
        for (const Sight& part : parts_of(view, probe.T_world_sensor)) {
            const Samples seen = densest->visible_surface(part.view, part.T_world_sensor);
            out.push_back({part, mean_echoes(scene, part.view, seen), seen.estimated_l1});
        }
    }
    return out;
}

}  // namespace

RaysDensity density_for(const Scene& scene, const Caster& caster, const View& view,
                        std::span<const Probe> probes) {
    const std::vector<DensestImage> images = densest_images(scene, caster, view, probes);
    for (const int density : densities) {
        if (density == densities.back()) break;
        const auto rays = make_rays_engine(scene, caster, {density});
        double worst = 0.0;
        for (const auto& [part, image, error] : images) {
            const Samples seen = rays->visible_surface(part.view, part.T_world_sensor);
            worst =
                std::max(worst, image_change(mean_echoes(scene, part.view, seen), image) + error);
            if (worst > view.relative_l1) break;
        }
        if (worst <= view.relative_l1) return {density, worst};
    }
    return {densities.back(), std::numeric_limits<double>::quiet_NaN()};
}

std::unique_ptr<VisibilityEngine> make_dense_rays_engine(const Scene& scene, const Caster& caster,
                                                         std::span<const Probe> probes) {
    std::vector<EngineOfView> views;
    int most = densities.front();
    for (const Probe& probe : probes) {
        if (std::ranges::find(views, probe.view, &EngineOfView::view) != views.end()) continue;
        const RaysNeed need = required_rays(probe.view, probes);
        if (need.goal > 0.0) {
            views.push_back({probe.view, need.goal,
                             make_rays_engine(scene, caster, {.columns = need.columns})});
            continue;
        }
        const auto [density, error] = density_for(scene, caster, probe.view, probes);
        most = std::max(most, density);
        views.push_back({probe.view, probe.view.relative_l1,
                         make_rays_engine(scene, caster, {density}), error});
    }
    return make_engine_by_view(make_rays_engine(scene, caster, {most}), std::move(views));
}

}  // namespace sonarsim
