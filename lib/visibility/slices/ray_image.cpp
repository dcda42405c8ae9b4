#include "visibility/slices/ray_image.h"

#include <algorithm>
#include <cmath>

#include "visibility/angles.h"
#include "visibility/reference_cast.h"

namespace sonarsim {

namespace {

// Rays over directions in the first two casts, and in all casts at most. Chosen.
constexpr std::size_t first_rays = 1U << 13U;
constexpr std::size_t most_rays = 1U << 19U;

// Draws of its own: the reference of `report` has the starts 0 and 1.
constexpr std::uint32_t first_start = 1000;

// A bin with fewer rays than this does not show its variance. The standard deviation of its echoes
// is taken as this share of their mean. Chosen.
constexpr double fewest_rays = 16.0;
constexpr double assumed_deviation = 0.5;

// Standard deviations that are forgiven.
constexpr double forgiven = 2.0;

}  // namespace

void RayImage::Bin::add(const Bin& other) {
    rays += other.rays;
    area += other.area;
    echo += other.echo;
    area2 += other.area2;
    area2_echo += other.area2_echo;
    area2_echo2 += other.area2_echo2;
}

RayImage::RayImage(const Scene& scene, const Caster& caster, const View& view,
                   const LocalPose& pose, double noise)
    : bins_(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.range_bins)) {
    const std::vector<SurfaceShare> shares = surface_shares(scene, view, pose);
    const ReferenceView looking{caster, scene, view, pose, shares};
    const int per_beam = view.shape == ViewShape::fan ? 1 : 16;
    const std::size_t columns = view_columns(view, per_beam).size();
    std::uint32_t start = first_start;
    const auto cast = [&](std::size_t rays) {
        std::vector<Bin> bins(bins_.size());
        const int count = static_cast<int>(std::max<std::size_t>(rays / columns, 1));
        rays_ +=
            cast_over_surface(looking, {per_beam, count, start++}, [&](const SurfacePoint& point) {
                const double bin = std::floor((point.range_m - view.range_min_m) / view.bin_m());
                if (!(bin >= 0.0 && bin < view.range_bins)) return;
                // Samples get the materials of maps later (trace/lay_maps.h).
                const double x =
                    point.cosine *
                    static_cast<double>(scene.materials[point.facet.material].reflection);
                const double w = point.area_m2 * count;
                bins[static_cast<std::size_t>(point.beam) * view.range_bins +
                     static_cast<std::size_t>(bin)]
                    .add({1.0, w, w * x, w * w, w * w * x, w * w * x * x});
            });
        return bins;
    };
    bins_ = cast(first_rays);
    for (std::size_t rays = first_rays; noise_ > noise && rays <= most_rays / 2; rays *= 2) {
        const std::vector<Bin> half = cast(rays);
        double apart = 0.0;
        double independent = 0.0;
        signal_ = 0.0;
        evenness_ = 1.0;
        for (std::size_t k = 0; k < bins_.size(); ++k) {
            apart += std::fabs(bins_[k].mean() - half[k].mean());
            bins_[k].add(half[k]);
            independent += deviation(bins_[k]);
            signal_ += bins_[k].mean();
        }
        // The mean of two halves deviates by half of their difference.
        const double apart_per_deviation = 2.0 * std::sqrt(2.0 / pi);
        const double deviations = apart / apart_per_deviation;
        evenness_ = independent > 0.0 ? std::min(deviations / independent, 1.0) : 1.0;
        noise_ = signal_ > 0.0 ? deviations / signal_ : 0.0;
    }
}

double RayImage::deviation(const Bin& bin) const {
    if (!(bin.rays > 0.0)) return 0.0;
    const double mean = bin.mean();
    const double squares = bin.area2_echo2 - 2.0 * mean * bin.area2_echo + mean * mean * bin.area2;
    const double independent = std::sqrt(std::max(squares, 0.0)) / bin.area;
    if (bin.rays >= fewest_rays) return evenness_ * independent;
    return std::max(independent, assumed_deviation * mean / std::sqrt(bin.rays));
}

double RayImage::error_of(const SampledImage& image, std::span<const EdgeBin> edges) const {
    if (!(signal_ > 0.0)) return 0.0;
    double error = 0.0;
    for (std::size_t k = 0; k < bins_.size(); ++k) {
        const auto intensity = static_cast<double>(image.intensity(k));
        if (bins_[k].rays < fewest_rays && edges[k] == EdgeBin::filled) continue;
        const double difference = intensity - bins_[k].mean();
        const double noise = forgiven * deviation(bins_[k]);
        error += std::sqrt(std::max(difference * difference - noise * noise, 0.0));
    }
    return error / signal_;
}

}  // namespace sonarsim
