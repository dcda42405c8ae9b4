#include "ping/pipeline.h"

#include <algorithm>

#include "core/clock.h"
#include "ping/accumulate.h"
#include "ping/echoes.h"
#include "ping/multipath_echoes.h"
#include "ping/range_noise.h"

namespace sonarsim {

namespace {

ScattererLattice lattice_for(const RangeNoise& noise, const Scene& scene,
                             const Pose& T_world_sensor) {
    if (noise.lambda_m <= 0.0F) return {};
    return {noise.scatterer_m, T_world_sensor.rotation.toRotationMatrix().cast<float>(),
            (T_world_sensor.translation - scene.origin).cast<float>()};
}

/// [beams, bins] to [bins, beams], in tiles that stay in the cache.
void transpose(const std::vector<float>& by_beam, Ping& ping) {
    constexpr int tile = 16;
    for (int i0 = 0; i0 < ping.range_bins; i0 += tile) {
        const int i1 = std::min(i0 + tile, ping.range_bins);
        for (int j0 = 0; j0 < ping.beams; j0 += tile) {
            const int j1 = std::min(j0 + tile, ping.beams);
            for (int i = i0; i < i1; ++i) {
                for (int j = j0; j < j1; ++j) {
                    ping.intensity[static_cast<std::size_t>(i) * ping.beams + j] =
                        by_beam[static_cast<std::size_t>(j) * ping.range_bins + i];
                }
            }
        }
    }
}

}  // namespace

Ping run_pipeline(const PingSettings& settings, const Scene& scene, const VisibilityEngine& engine,
                  const Pose& T_world_sensor, const PingKey& key) {
    const View& view = settings.view;
    const Streaks& streaks = settings.streaks;
    const RangeBins bins{static_cast<float>(view.range_min_m), static_cast<float>(view.bin_m()),
                         view.range_bins};
    const ScattererLattice lattice = lattice_for(settings.range_noise, scene, T_world_sensor);
    const auto stream = [&](Stream s) {
        return stream_key(key.seed, settings.stream, key.ping, s);
    };
    const auto add_noise = [&](Echoes& to, Stream s) {
        if (!lattice.exists()) return;
        add_range_noise(to, settings.range_noise.lambda_m, settings.range_noise.fades, stream(s));
    };
    Ping ping{view.range_bins, view.beams, {}, {}, {}};
    ping.intensity.resize(static_cast<std::size_t>(view.range_bins) * view.beams);
    Stopwatch watch;

    // III-A: the visible surface.
    const Samples samples = engine.visible_surface(view, T_world_sensor);
    ping.counts.samples = samples.items.size();
    ping.counts.dropped_samples = samples.dropped;
    ping.seconds.trace = watch.lap();

    // III-B: multipath [1-3].
    std::vector<Bounce> bounces;
    if (settings.multipath.on) {
        bounces = find_bounces(settings.multipath, view, samples, scene.materials, engine,
                               T_world_sensor, ping.counts.multipath);
    }
    ping.seconds.multipath = watch.lap();

    // III-C, III-D: echoes [4-6], their range noise [7-8] and the mean of every bin [9].
    MultipathEchoes bounced = multipath_echoes(bounces, samples, view, lattice);
    add_noise(bounced.echoes, Stream::multipath_range_noise);
    std::vector<float> by_beam(ping.intensity.size());
    RowAreas areas(bins.count);
    Echoes echoes;
    BinSums sums;
    const auto add_direct = [&](std::span<const Sample> from, BinSums& to) {
        direct_echoes(from, scene.materials, bins.bin_m, lattice, echoes);
        add_noise(echoes, Stream::range_noise);
        return accumulate(echoes, bins, to);
    };
    for (int j = 0; j < view.beams; ++j) {
        sums.clear(bins.count);
        ping.counts.out_of_range += add_direct(samples.beam(j), sums);
        ping.counts.echoes += echoes.size();
        if (streaks.exist()) {
            areas.add(sums);
            add_direct(at_normal_incidence(samples.beam(j), streaks.least_cosine), areas.normal);
        }
        ping.counts.out_of_range += accumulate(bounced.echoes, bounced.beam_begin[j],
                                               bounced.beam_begin[j + 1], bins, sums);
        const std::size_t column = static_cast<std::size_t>(j) * bins.count;
        ping.counts.occupied_bins +=
            mean_of_bins(sums, std::span(by_beam).subspan(column, bins.count));
    }
    ping.counts.echoes += bounced.echoes.size();
    transpose(by_beam, ping);
    ping.seconds.accumulate = watch.lap();

    // III-D: pixel noise [10-13]. III-E: streaks [14-15].
    ping.counts.negative_pixels =
        add_pixel_noise(ping.intensity, settings.pixel_noise, stream(Stream::pixel_noise));
    if (streaks.exist()) ping.counts.streak_rows = add_streaks(ping.intensity, areas, streaks);
    ping.seconds.noise = watch.lap();
    return ping;
}

}  // namespace sonarsim
