#include "validation/reference.h"

#include <algorithm>
#include <utility>

#include "validation/image_error.h"
#include "validation/reference_cast.h"

namespace sonarsim {

namespace {

std::vector<float> image_of(const SurfaceSums& sums) {
    std::vector<float> image(sums.area.size(), 0.0F);
    for (std::size_t k = 0; k < image.size(); ++k) {
        if (sums.area[k] > 0.0) image[k] = static_cast<float>(sums.echo[k] / sums.area[k]);
    }
    return image;
}

/// Both casts together. Each sums up the whole surface, so their quotient is that of one cast.
SurfaceSums together(SurfaceSums a, const SurfaceSums& b) {
    for (std::size_t k = 0; k < a.area.size(); ++k) {
        a.area[k] += b.area[k];
        a.echo[k] += b.echo[k];
    }
    a.rays += b.rays;
    a.hits += b.hits;
    return a;
}

double hits_per_bin(const SurfaceSums& sums) {
    const auto lit = std::ranges::count_if(sums.area, [](double area) { return area > 0.0; });
    return lit ? static_cast<double>(sums.hits) / static_cast<double>(lit) : 0.0;
}

}  // namespace

Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal) {
    const std::size_t bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    const LocalPose pose = local_pose(T_world_sensor, scene.origin);
    const std::vector<SurfaceShare> shares = surface_shares(scene, view, pose);
    const ReferenceView looking{caster, scene, view, pose, shares};
    Reference reference{view.range_bins, view.beams, std::vector<float>(bins, 0.0F)};
    int per_beam = view.shape == ViewShape::fan ? 1 : 16;
    int count = 256;  // per column
    double last_moved = 1.0;
    for (bool wider = false;; wider = !wider) {
        const SurfaceSums lattice = cast_over_surface(looking, {per_beam, count, 0});
        const SurfaceSums scattered = cast_over_surface(looking, {per_beam, count, 1});
        const SurfaceSums both = together(lattice, scattered);
        std::vector<float> image = image_of(both);
        reference.apart = std::max(image_error(image_of(lattice), image).relative_l1,
                                   image_error(image_of(scattered), image).relative_l1);
        // Along and across are doubled in turn; the image has settled when neither moves it.
        const double moved = image_error(reference.intensity, image).relative_l1;
        reference.moved = std::max({moved, std::exchange(last_moved, moved), reference.apart});
        reference.rays_per_bin = hits_per_bin(both);
        reference.intensity = std::move(image);
        const bool met = reference.moved < goal.moved &&
                         (both.hits == 0 || reference.rays_per_bin >= goal.rays_per_bin);
        if (met || 2 * both.rays > goal.rays_max) return reference;
        if (wider) {
            per_beam *= 2;
        } else {
            count *= 2;
        }
    }
}

}  // namespace sonarsim
