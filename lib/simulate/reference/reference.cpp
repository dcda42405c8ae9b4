#include "simulate/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/reference/image_error.h"
#include "simulate/reference/reference_cast.h"

namespace sonarsim {

namespace {

/// Sums over the visible surface in every bin, [range_bins, beams].
struct SurfaceSums {
    std::vector<double> area;  ///< m^2
    std::vector<double> echo;  ///< area times echo, m^2
    std::uint64_t rays = 0;    ///< all rays cast
    std::uint64_t hits = 0;    ///< rays that met surface in range
};

SurfaceSums sums_over_surface(const ReferenceView& looking, const RayLayout& layout) {
    const View& view = looking.view;
    const std::size_t bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    SurfaceSums sums{std::vector<double>(bins), std::vector<double>(bins)};
    sums.rays = cast_over_surface(looking, layout, [&](const SurfacePoint& point) {
        const double bin = std::floor((point.range_m - view.range_min_m) / view.bin_m());
        if (!(bin >= 0.0 && bin < view.range_bins)) return;
        const std::size_t k = static_cast<std::size_t>(bin) * view.beams + point.beam;
        const MappedPoint surface = surface_at(point, looking.scene, looking.pose);
        sums.area[k] += point.area_m2;
        sums.echo[k] += point.area_m2 * point.cosine *
                        looking.scene.materials[surface.material].reflection * surface.strength;
        ++sums.hits;
    });
    return sums;
}

std::vector<float> image_of(const SurfaceSums& sums) {
    std::vector<float> image(sums.area.size(), 0.0F);
    for (std::size_t k = 0; k < image.size(); ++k) {
        if (sums.area[k] > 0.0) image[k] = static_cast<float>(sums.echo[k] / sums.area[k]);
    }
    return image;
}

/// Adds both casts. Each sums over the whole surface, so their quotient is that of one cast.
SurfaceSums together(SurfaceSums a, const SurfaceSums& b) {
    for (std::size_t k = 0; k < a.area.size(); ++k) {
        a.area[k] += b.area[k];
        a.echo[k] += b.echo[k];
    }
    a.rays += b.rays;
    a.hits += b.hits;
    return a;
}

/// Rays per column of the first cast: fewer than usual where already these would be too many.
int first_count(const View& view, int per_beam, const ReferenceGoal& goal) {
    constexpr int usual = 256;
    constexpr int fewest = 16;
    constexpr double rays_per_direction = 3.0;  // two starts, and points for half as many rays
    const double columns = static_cast<double>(view.beams) * per_beam;
    const double most = static_cast<double>(goal.rays_max) / (rays_per_direction * columns);
    return static_cast<int>(std::clamp(most, double{fewest}, double{usual}));
}

}  // namespace

Reference settled(const View& view, const ReferenceGoal& goal,
                  const std::function<CastResult(int per_beam, int count)>& cast) {
    const std::size_t bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    Reference reference{view.range_bins, view.beams, std::vector<float>(bins, 0.0F), {}};
    int per_beam = view.shape == ViewShape::fan ? 1 : 16;
    int count = first_count(view, per_beam, goal);
    double last_moved = 1.0;
    for (bool wider = false;; wider = !wider) {
        CastResult now = cast(per_beam, count);
        reference.scored.resize(bins);
        std::ranges::transform(now.area_m2, reference.scored.begin(),
                               [&](double area) { return area >= goal.cell_m2; });
        const auto error = [&](const std::vector<float>& image) {
            return image_error(image, now.both, reference.scored).relative_l1;
        };
        reference.apart = std::max(error(now.lattice), error(now.scattered));
        // The two directions are doubled in turn; the image has settled when neither changes it.
        const double moved = error(reference.intensity);
        reference.moved = std::max({moved, std::exchange(last_moved, moved), reference.apart});
        const auto occupied = std::ranges::count_if(now.both, [](float x) { return x > 0.0F; });
        reference.rays_per_bin =
            occupied > 0 ? static_cast<double>(now.hits) / static_cast<double>(occupied) : 0.0;
        reference.intensity = std::move(now.both);
        const bool met = reference.moved < goal.moved &&
                         (now.hits == 0 || reference.rays_per_bin >= goal.rays_per_bin);
        if (met || 2 * now.rays > goal.rays_max) return reference;
        if (wider) {
            per_beam *= 2;
        } else {
            count *= 2;
        }
    }
}

Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal) {
    const LocalPose pose = local_pose(T_world_sensor, scene.origin);
    const std::vector<SurfaceShare> shares = surface_shares(scene, view, pose);
    const ReferenceView looking{caster, scene, view, pose, shares};
    return settled(view, goal, [&](int per_beam, int count) -> CastResult {
        const SurfaceSums lattice = sums_over_surface(looking, {per_beam, count, 0});
        const SurfaceSums scattered = sums_over_surface(looking, {per_beam, count, 1});
        const SurfaceSums both = together(lattice, scattered);
        std::vector<double> area_m2(both.area.size());
        std::ranges::transform(both.area, area_m2.begin(), [](double sum) { return 0.5 * sum; });
        return {image_of(lattice), image_of(scattered), image_of(both), std::move(area_m2),
                both.rays, both.hits};
    });
}

}  // namespace sonarsim
