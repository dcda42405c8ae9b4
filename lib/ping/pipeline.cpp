#include "ping/pipeline.h"

#include "core/clock.h"
#include "ping/accumulate.h"
#include "ping/echoes.h"
#include "ping/multipath_echoes.h"

namespace sonarsim {

TracedPing trace_ping(const PingSettings& settings, const Scene& scene,
                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                      const Terms& terms) {
    TracedPing traced;
    traced.T_world_sensor = T_world_sensor;
    Stopwatch watch;

    // III-A: the visible surface.
    traced.samples = engine.visible_surface(settings.view, T_world_sensor);
    traced.counts.samples = traced.samples.items.size();
    traced.counts.dropped_samples = traced.samples.dropped;
    traced.seconds.trace = watch.lap();

    // III-B: multipath, Eq. 1-3.
    if (terms.multipath) trace_multipath(settings, scene, engine, traced);
    return traced;
}

void trace_multipath(const PingSettings& settings, const Scene& scene,
                     const VisibilityEngine& engine, TracedPing& traced) {
    Stopwatch watch;
    traced.counts.multipath = {};
    traced.bounces.clear();
    if (settings.multipath.on) {
        traced.bounces =
            find_bounces(settings.multipath, settings.view, traced.samples, scene.materials, engine,
                         traced.T_world_sensor, traced.counts.multipath);
    }
    traced.seconds.multipath = watch.lap();
}

Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms) {
    const View& view = settings.view;
    const RangeBins bins{.min_m = static_cast<float>(view.range_min_m),
                         .bin_m = static_cast<float>(view.bin_m()),
                         .count = view.range_bins};
    const RangeNoise range_noise = terms.range_noise ? settings.range_noise : RangeNoise{};
    const Streaks streaks = terms.streaks ? settings.streaks : Streaks{};
    const ScattererLattice lattice = scatterer_lattice(range_noise, scene, traced.T_world_sensor);
    const auto draws = [&](Stream stream) {
        return stream_key(key.seed, settings.stream, key.ping, stream);
    };
    Ping ping;
    ping.range_bins = view.range_bins;
    ping.beams = view.beams;
    ping.counts = traced.counts;
    ping.seconds = traced.seconds;
    Stopwatch watch;

    // III-C: multipath as echoes.
    if (!terms.multipath) ping.counts.multipath = {};
    MultipathEchoes bounced =
        multipath_echoes(terms.multipath ? std::span(traced.bounces) : std::span<const Bounce>(),
                         traced.samples, view, lattice);
    add_range_noise(bounced.echoes, range_noise, draws(Stream::multipath_range_noise));
    ping.counts.echoes = bounced.echoes.size();

    // III-C, III-D: for every beam the echoes of its surface, Eq. 4-6, their range noise, Eq. 7-8,
    // and the mean of each bin, Eq. 9.
    std::vector<float> by_beam(static_cast<std::size_t>(view.beams) * bins.count);
    RowAreas areas(bins.count);
    Echoes echoes;
    BinSums sums;
    const auto add_direct = [&](std::span<const Sample> samples, BinSums& to) {
        direct_echoes(samples, scene.materials, bins.bin_m, lattice, echoes);
        add_range_noise(echoes, range_noise, draws(Stream::range_noise));
        return accumulate(echoes, bins, to);
    };
    for (int j = 0; j < view.beams; ++j) {
        sums.clear(bins.count);
        if (terms.direct) {
            ping.counts.out_of_range += add_direct(traced.samples.beam(j), sums);
            ping.counts.echoes += echoes.size();
        }
        if (streaks.exist()) {
            areas.add(sums);
            add_direct(at_normal_incidence(traced.samples.beam(j), streaks.least_cosine),
                       areas.normal);
        }
        ping.counts.out_of_range += accumulate(bounced.echoes, bounced.beam_begin[j],
                                               bounced.beam_begin[j + 1], bins, sums);
        ping.counts.occupied_bins += mean_of_bins(
            sums, std::span(by_beam).subspan(static_cast<std::size_t>(j) * bins.count, bins.count));
    }
    ping.intensity = image_of_beams(by_beam, view.range_bins, view.beams);
    ping.seconds.accumulate = watch.lap();

    // III-D: pixel noise, Eq. 10-13. III-E: streaks, Eq. 14-15.
    if (terms.pixel_noise) {
        ping.counts.negative_pixels =
            add_pixel_noise(ping.intensity, settings.pixel_noise, draws(Stream::pixel_noise));
    }
    if (streaks.exist()) ping.counts.streak_rows = add_streaks(ping.intensity, areas, streaks);
    ping.seconds.noise = watch.lap();
    return ping;
}

}  // namespace sonarsim
