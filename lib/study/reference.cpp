#include "study/reference.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "study/image_error.h"

namespace sonarsim {

namespace {

struct Sums {
    std::vector<double> weight;
    std::vector<double> echo;
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
};

/// Adds the rays of one column of the view: azimuth `phi`, `count` elevations.
void cast_column(const Caster& caster, const Scene& scene, const View& view, const Pose& local,
                 int beam, double phi, int count, double offset, Sums& sums) {
    const Eigen::Matrix3d R = local.rotation.toRotationMatrix();
    const Eigen::Vector3f origin = local.translation.cast<float>();
    const SinCos azimuth = sincos(phi);
    std::vector<Eigen::Vector3f> directions(count);
    std::vector<std::uint32_t> facets(count);
    for (int i = 0; i < count; ++i) {
        const double theta = view.elevation_rad * ((i + offset) / count - 0.5);
        const SinCos elevation = sincos(theta);
        directions[i] = (R * Eigen::Vector3d(elevation.cos * azimuth.cos,
                                             elevation.cos * azimuth.sin, elevation.sin))
                            .cast<float>();
    }
    caster.cast(origin, directions, static_cast<float>(view.range_max_m) * 1.01F, facets);
    for (int i = 0; i < count; ++i) {
        if (facets[i] == Caster::nothing) continue;
        const Facet& facet = caster.facet(facets[i]);
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        const Eigen::Vector3d ray = directions[i].cast<double>();
        const double along = normal.dot(ray);
        const double range = normal.dot((facet.vertex - origin).cast<double>()) / along;
        const double bin = std::floor((range - view.range_min_m) / view.bin_m());
        if (!(bin >= 0.0 && bin < view.range_bins)) continue;
        const double theta = view.elevation_rad * ((i + offset) / count - 0.5);
        const double cosine = std::fabs(along);
        const double area = range * range * sincos(theta).cos / cosine;
        const std::size_t k = static_cast<std::size_t>(bin) * view.beams + beam;
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
    int columns = 2;  // per beam
    int count = 256;  // per column
    // Of the fraction of a step by which each column's lattice is shifted, so that edges that run
    // along the lattice are met at every phase.
    constexpr double golden = 0.6180339887498949;
    Sums sums;
    for (bool wider = false;; wider = !wider) {
        sums = {std::vector<double>(bins, 0.0), std::vector<double>(bins, 0.0), 0, 0};
        for (int j = 0; j < view.beams; ++j) {
            for (int c = 0; c < columns; ++c) {
                const double phi =
                    view.azimuth_rad * ((j + (c + 0.5) / columns) / view.beams - 0.5);
                const double turns = golden * (static_cast<double>(j) * columns + c);
                cast_column(caster, scene, view, local, j, phi, count, turns - std::floor(turns),
                            sums);
            }
        }
        std::vector<float> image(bins, 0.0F);
        std::size_t occupied = 0;
        for (std::size_t k = 0; k < bins; ++k) {
            if (sums.weight[k] <= 0.0) continue;
            image[k] = static_cast<float>(sums.echo[k] / sums.weight[k]);
            ++occupied;
        }
        reference.moved = image_error(reference.intensity, image).relative_l1;
        reference.rays_per_bin =
            occupied ? static_cast<double>(sums.hits) / static_cast<double>(occupied) : 0.0;
        reference.intensity = std::move(image);
        const bool met = reference.moved < goal.moved &&
                         (occupied == 0 || reference.rays_per_bin >= goal.rays_per_bin);
        if (met || 2 * sums.rays > goal.rays_max) return reference;
        // Elevations carry the range resolution: they grow fourfold while columns double.
        if (wider) {
            columns *= 2;
        } else {
            count *= 2;
        }
    }
}

}  // namespace sonarsim
