#include "simulate/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sonarsim {

namespace {

constexpr std::size_t independent_casts = 4;

CastResult sums_over_surface(const ReferenceView& looking, const RayLayout& layout) {
    const View& view = looking.view;
    const std::size_t bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    CastResult sums{std::vector<double>(bins), std::vector<double>(bins), {}};
    sums.rays = cast_over_surface(looking, layout, [&](const SurfacePoint& point) {
        const double bin = std::floor((point.range_m - view.range_min_m) / view.bin_m());
        if (!(bin >= 0.0 && bin < view.range_bins)) return;
        const std::size_t k = static_cast<std::size_t>(bin) * view.beams + point.beam;
        const MappedPoint surface = surface_at(point, looking.scene, looking.pose);
        sums.weight[k] += point.area_m2;
        sums.echo[k] += point.area_m2 * point.cosine *
                        looking.scene.materials[surface.material].reflection * surface.strength;
        ++sums.hits;
    });
    sums.area_m2 = sums.weight;
    return sums;
}

/// Rays per column of the first casts: fewer than usual where already these would be too many.
int first_count(const View& view, int per_beam, const ReferenceGoal& goal) {
    constexpr int usual = 64;
    constexpr int fewest = 8;
    constexpr double rays_per_direction = 1.5 * independent_casts;  // points for half as many rays
    const double columns = static_cast<double>(view.beams) * per_beam;
    const double affordable = static_cast<double>(goal.rays_max) / (rays_per_direction * columns);
    return static_cast<int>(std::clamp(affordable, double{fewest}, double{usual}));
}

/// A bin's sums of all casts.
struct SumsOfCasts {
    double echo = 0.0;
    double weight = 0.0;

    double value() const { return weight > 0.0 ? echo / weight : 0.0; }
};

SumsOfCasts sums_of_casts(const std::vector<CastSums>& casts, std::size_t bin) {
    SumsOfCasts sums;
    for (const CastSums& cast : casts) {
        sums.echo += static_cast<double>(cast.echo[bin]);
        sums.weight += static_cast<double>(cast.weight[bin]);
    }
    return sums;
}

/// a / b, with 0 for 0 / 0 and 1 for other divisions by 0.
double share(double a, double b) {
    if (b > 0.0) return a / b;
    return a > 0.0 ? 1.0 : 0.0;
}

/// The sum over scored bins of what `bin_value` gives, as a share() of the sum of the image there.
template <class BinValue>
double relative(const Reference& reference, const BinValue& bin_value) {
    double sum = 0.0;
    double image = 0.0;
    for (std::size_t k = 0; k < reference.scored.size(); ++k) {
        if (reference.scored[k] == 0) continue;
        const SumsOfCasts all = sums_of_casts(reference.casts, k);
        sum += bin_value(k, all);
        image += all.value();
    }
    return share(sum, image);
}

/// A cast differs from the mean of n by sqrt(n - 1) times the deviation of this mean.
double noise_of(const Reference& reference) {
    const auto n = static_cast<double>(reference.casts.size());
    return relative(reference, [&](std::size_t k, const SumsOfCasts& all) {
        double sum = 0.0;
        for (const CastSums& cast : reference.casts)
            sum += std::fabs(cast.echo[k] - all.value() * cast.weight[k]);
        return sum / (all.weight * std::sqrt(n - 1.0));
    });
}

/// The noise that can be expected of `later` rays: between that of a lattice over edges, by the
/// number of rays, and that of a grainy surface, by its root.
double noise_by(double noise, std::uint64_t rays, std::uint64_t later) {
    const double root = std::sqrt(static_cast<double>(rays) / static_cast<double>(later));
    return noise * root * std::sqrt(root);
}

struct Total {
    explicit Total(const View& view)
        : bins(static_cast<std::size_t>(view.range_bins) * view.beams),
          area_m2(bins),
          reference{view.range_bins,
                    view.beams,
                    std::vector<float>(bins),
                    std::vector<std::uint8_t>(bins),
                    {}} {
        reference.casts.assign(independent_casts,
                               {std::vector<float>(bins), std::vector<float>(bins)});
    }

    /// Adds one cast to each. Advances the start of the layout.
    void add_round(RayLayout& layout, double weight,
                   const std::function<CastResult(const RayLayout&)>& cast) {
        for (CastSums& sums : reference.casts) {
            const CastResult found = cast(layout);
            ++layout.start;
            for (std::size_t k = 0; k < bins; ++k) {
                sums.echo[k] += static_cast<float>(weight * found.echo[k]);
                sums.weight[k] += static_cast<float>(weight * found.weight[k]);
                area_m2[k] += weight * found.area_m2[k];
            }
            weights += weight;
            rays += found.rays;
            hits += found.hits;
        }
    }

    Reference& evaluate(double cell_m2) {
        std::size_t occupied = 0;
        for (std::size_t k = 0; k < bins; ++k) {
            reference.intensity[k] = static_cast<float>(sums_of_casts(reference.casts, k).value());
            reference.scored[k] = area_m2[k] >= cell_m2 * weights;
            occupied += reference.intensity[k] > 0.0F;
        }
        reference.noise = noise_of(reference);
        reference.rays_per_bin =
            occupied > 0 ? static_cast<double>(hits) / static_cast<double>(occupied) : 0.0;
        return reference;
    }

    std::size_t bins;
    std::vector<double> area_m2;  ///< sum over the casts by their weights
    double weights = 0.0;
    std::uint64_t hits = 0;
    std::uint64_t rays = 0;
    Reference reference;
};

}  // namespace

Reference settled(const View& view, const ReferenceGoal& goal,
                  const std::function<CastResult(const RayLayout&)>& cast) {
    RayLayout layout{view.shape == ViewShape::fan ? 1 : 16, 0, goal.start};
    layout.count = first_count(view, layout.per_beam, goal);
    Total total(view);
    bool wider = false;
    for (double weight = 1.0;; weight *= 2.0) {
        const std::uint64_t before = total.rays;
        total.add_round(layout, weight, cast);
        Reference& reference = total.evaluate(goal.cell_m2);
        const bool met = reference.noise < goal.noise &&
                         (total.hits == 0 || reference.rays_per_bin >= goal.rays_per_bin);
        const bool hopeless =
            goal.gives_up && noise_by(reference.noise, total.rays, goal.rays_max) > goal.noise;
        if (met || hopeless || total.rays + 2 * (total.rays - before) > goal.rays_max)
            return std::move(reference);
        (wider ? layout.per_beam : layout.count) *= 2;
        wider = !wider;
    }
}

Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal) {
    const ReferenceView looking{caster, scene, view, T_world_sensor};
    return settled(view, goal,
                   [&](const RayLayout& layout) { return sums_over_surface(looking, layout); });
}

double error_without_noise(std::span<const float> image, const Reference& truth) {
    const auto sign = [](double x) { return static_cast<double>(x > 0.0) - (x < 0.0); };
    const auto n = static_cast<double>(truth.casts.size());
    const double error = relative(truth, [&](std::size_t k, const SumsOfCasts& all) {
        const double a = image[k];
        const auto by = [&](const CastSums& cast) { return a * cast.weight[k] - cast.echo[k]; };
        double signs = 0.0;
        for (const CastSums& cast : truth.casts)
            signs += sign(by(cast));
        double sum = 0.0;
        for (const CastSums& cast : truth.casts) {
            const double own = by(cast);
            const double by_others = sign(a * all.weight - all.echo - own);
            const double by_one_other = (signs - sign(own)) / (n - 1.0);
            sum += own * (by_others + (by_others - by_one_other) / (n - 2.0));
        }
        return sum / all.weight;
    });
    return std::max(0.0, error);
}

ImageError image_error(std::span<const float> image, std::span<const float> truth,
                       std::span<const std::uint8_t> scored) {
    double difference = 0.0;
    double truth_sum = 0.0;
    double missed = 0.0;
    double occupied = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        if (!scored.empty() && scored[k] == 0) continue;
        const double a = image[k];
        const double b = truth[k];
        difference += std::fabs(a - b);
        truth_sum += b;
        missed += b > 0.0 && !(a > 0.0);
        occupied += b > 0.0;
    }
    return {share(difference, truth_sum), share(missed, occupied)};
}

}  // namespace sonarsim
