#include "validation/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/elementary.h"
#include "validation/image_error.h"
#include "visibility/angles.h"

namespace sonarsim {

namespace {

struct Sums {
    std::vector<double> weight;
    std::vector<double> echo;
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
};

/// dOmega / (d across d along) of a direction.
double solid_angle_density(ViewShape shape, double across, double along) {
    switch (shape) {
        case ViewShape::sides:
            return sincos(across).cos;
        case ViewShape::cone:
            return sincos(along).sin;
        default:
            return sincos(along).cos;
    }
}

/// Adds `count` rays along a column, shifted by the fraction `offset` of a step.
void cast_column(const Caster& caster, const Scene& scene, const View& view, const Pose& local,
                 const ViewColumn& column, int count, double offset, Sums& sums) {
    const Eigen::Matrix3f R = local.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f origin = local.translation.cast<float>();
    const SinCosFloat across = sincos_float(column.across);
    const double step = (column.along_max - column.along_min) / count;
    std::vector<Eigen::Vector3f> directions(count);
    std::vector<std::uint32_t> facets(count);
    for (int i = 0; i < count; ++i) {
        const double along = column.along_min + (i + offset) * step;
        directions[i] = R * direction(view.shape, across, sincos_float(along));
    }
    caster.cast(origin, directions, static_cast<float>(view.range_max_m) * 1.01F, facets);
    for (int i = 0; i < count; ++i) {
        if (facets[i] == Caster::nothing) continue;
        const Facet& facet = caster.facet(facets[i]);
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        const Eigen::Vector3d ray = directions[i].cast<double>();
        const double facing = normal.dot(ray);
        const double range = normal.dot((facet.vertex - origin).cast<double>()) / facing;
        const double bin = std::floor((range - view.range_min_m) / view.bin_m());
        if (!(bin >= 0.0 && bin < view.range_bins)) continue;
        const double along = column.along_min + (i + offset) * step;
        const double cosine = std::fabs(facing);
        const double area = range * range * solid_angle_density(view.shape, column.across, along) *
                            step * column.width / cosine;
        const std::size_t k = static_cast<std::size_t>(bin) * view.beams + column.beam;
        sums.weight[k] += area;
        sums.echo[k] += area * cosine * scene.materials[facet.material].reflection;
        ++sums.hits;
    }
    sums.rays += count;
}

}  // namespace

Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal) {
    const std::size_t bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    const Pose local{T_world_sensor.rotation, T_world_sensor.translation - scene.origin};
    Reference reference{view.range_bins, view.beams, std::vector<float>(bins, 0.0F), 1.0, 0.0};
    int per_beam = view.shape == ViewShape::fan ? 2 : 32;
    int count = 256;  // per column
    // Of the fraction of a step by which each column's lattice is shifted, so that edges that run
    // along the lattice are met at every phase.
    constexpr double golden = 0.6180339887498949;
    Sums sums;
    double last_moved = 1.0;
    for (bool wider = false;; wider = !wider) {
        sums = {std::vector<double>(bins, 0.0), std::vector<double>(bins, 0.0), 0, 0};
        double shift = 0.0;
        for (const ViewColumn& column : view_columns(view, per_beam)) {
            shift += golden;
            cast_column(caster, scene, view, local, column, count, shift - std::floor(shift), sums);
        }
        std::vector<float> image(bins, 0.0F);
        std::size_t occupied = 0;
        for (std::size_t k = 0; k < bins; ++k) {
            if (sums.weight[k] <= 0.0) continue;
            image[k] = static_cast<float>(sums.echo[k] / sums.weight[k]);
            ++occupied;
        }
        // Along and across are doubled in turn; the image has settled when neither moves it.
        const double moved = image_error(reference.intensity, image).relative_l1;
        reference.moved = std::max(moved, std::exchange(last_moved, moved));
        reference.rays_per_bin =
            occupied ? static_cast<double>(sums.hits) / static_cast<double>(occupied) : 0.0;
        reference.intensity = std::move(image);
        const bool met = reference.moved < goal.moved &&
                         (occupied == 0 || reference.rays_per_bin >= goal.rays_per_bin);
        if (met || 2 * sums.rays > goal.rays_max) return reference;
        if (wider) {
            per_beam *= 2;
        } else {
            count *= 2;
        }
    }
}

}  // namespace sonarsim
