#include "simulate/assembly/brightness.h"

#include <tbb/task_arena.h>

#include <array>
#include <cmath>

#include "simulate/assembly/poses.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/rays/rays_engine.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_pings_for_white = 8;  // per sonar
constexpr std::size_t max_slow = 3;             // per sonar with a slow echo model
constexpr std::size_t max_bins = 1U << 24;      // in all probes of a sonar
constexpr double coarse_l1 = 0.1;               // brightness needs no fine sampling
constexpr double share_below_white = 0.99;      // quantile of the occupied bins
// A few glints far above all other echoes, as in the calibrated model, are allowed to saturate.
constexpr double share_usual = 0.9;
constexpr double max_above_usual = 10.0;
constexpr double full_scale_without_echo = 1.0;  // any value works

/// Rounds up to two digits by products: the last bit of powers depends on the library.
double two_digits_up(double value) {
    if (value == 0.0) return 0.0;
    double scale = 1.0;
    while (value * scale < 10.0)
        scale *= 10.0;
    double unit = 1.0;
    while (value >= 100.0 * unit)
        unit *= 10.0;
    return std::min(1e9, std::ceil(value * scale / unit) * unit / scale);
}

/// A quantile of the values, which are reordered.
float quantile(std::vector<float>& values, double share) {
    const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + index);
    return values[static_cast<std::size_t>(index)];
}

/// 1 for the bins [range bins, beams] with surface: in an image of the calibrated model nearly
/// every bin has an echo, of the water, a side lobe or the tail of a pulse. An echogram should show
/// such echoes, so all bins of a cone count, and its bottom may be white.
std::vector<std::uint8_t> bins_with_surface(const TracedPing& traced, const PingSettings& settings,
                                            const Scene& scene) {
    const RangeBins bins = range_bins(settings.view);
    const auto beams = static_cast<std::size_t>(settings.view.beams);
    // Models that average over a bin give 0 without surface, so all their bins may count.
    const bool all = settings.view.shape == ViewShape::cone || !settings.model->info.energies_add;
    std::vector<std::uint8_t> out(beams * static_cast<std::size_t>(bins.count), 1);
    if (all) return out;
    const std::array<std::uint32_t, EchoBlock::capacity> one_source{};
    const auto find = [&](const TracedPing& group, int /*number*/) {
        EchoSums sums(bins, settings.view.beams);
        settings.model->surface_echoes(
            group, settings.view, scene, {},
            [&](const EchoBlock& block) { sums.add(block, one_source); });
        for (std::size_t j = 0; j < beams; ++j) {
            const std::span<const std::uint8_t> column = sums.occupied(static_cast<int>(j));
            for (std::size_t i = 0; i < column.size(); ++i)
                out[i * beams + j] = column[i];
        }
        return out;
    };
    const auto take_beam = [&](const auto& from, int beam, auto& to) {
        for (auto at = static_cast<std::size_t>(beam); at < to.size(); at += beams)
            to[at] = from[at];
    };
    return by_groups(traced, find, take_beam, [](const auto&, const auto&) {});
}

double find_full_scale(const Mission& mission, const Scene& scene, const Trajectory& trajectory,
                       std::span<const Trajectory> motions, Sonar sonar,
                       const VisibilityEngine& engine) {
    View& view = sonar.settings.view;
    view.relative_l1 = std::max(view.relative_l1, coarse_l1);
    const auto bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    const std::size_t max_probes =
        sonar.settings.model->info.is_slow ? max_slow : max_pings_for_white;
    const std::size_t probes = std::clamp<std::size_t>(max_bins / bins, 1, max_probes);
    std::vector<float> occupied;
    for (const std::uint32_t pose : sample_pings(trajectory.size(), sonar.config.every, probes)) {
        const TimedPose& at = trajectory[pose];
        const SonarAtPose then(mission, sonar, pose);
        const TracedPing traced =
            trace(*then, scene, *engine_at(engine, motions, at.t_s), at.T_world_vehicle, pose);
        const PingKey key{mission.seed, pose};
        const Ping clean = form_image(traced, then->settings, scene, key, direct_echoes_alone);
        const Ping ping = form_image(traced, then->settings, scene, key);
        const std::vector<std::uint8_t> surface = bins_with_surface(traced, then->settings, scene);
        for (std::size_t i = 0; i < surface.size(); ++i) {
            if (surface[i] > 0 && clean.intensity[i] > 0.0F && ping.intensity[i] > 0.0F)
                occupied.push_back(ping.intensity[i]);
        }
    }
    if (occupied.empty()) return full_scale_without_echo;
    const double white = std::min<double>(quantile(occupied, share_below_white),
                                          max_above_usual * quantile(occupied, share_usual));
    return std::isfinite(white) ? two_digits_up(white) : full_scale_without_echo;
}

}  // namespace

Brightness find_full_scales(const Mission& mission, const Scene& scene,
                            const Trajectory& trajectory, std::span<const Trajectory> motions,
                            std::span<const Sonar> sonars, SharedTrees& trees) {
    Brightness out;
    for (const Sonar& sonar : sonars) {
        const double by_rule = sonar.settings.model->info.white;
        out.full_scales.push_back(mission.output.full_scale > 0.0 ? mission.output.full_scale
                                                                  : two_digits_up(by_rule));
    }
    const auto is_unknown = [](double full_scale) { return !(full_scale > 0.0); };
    if (std::ranges::none_of(out.full_scales, is_unknown)) return out;
    // A separate arena throws if there is no memory for more threads; Embree would end the program.
    tbb::task_arena arena;
    arena.execute([&] {
        out.caster = std::make_shared<const Caster>(trees.caster(scene));
        const std::unique_ptr<VisibilityEngine> engine = make_rays_engine(scene, *out.caster);
        for (std::size_t k = 0; k < sonars.size(); ++k) {
            if (!is_unknown(out.full_scales[k])) continue;
            out.full_scales[k] =
                find_full_scale(mission, scene, trajectory, motions, sonars[k], *engine);
        }
    });
    return out;
}

}  // namespace sonarsim
