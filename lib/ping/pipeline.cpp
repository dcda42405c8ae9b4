#include "ping/pipeline.h"

#include <algorithm>
#include <utility>

#include "calibrated/model.h"
#include "core/clock.h"
#include "paper/accumulate.h"
#include "paper/echoes.h"
#include "paper/multipath_echoes.h"
#include "trace/visible_surface.h"

namespace sonarsim {

namespace {

// As many floats as a cache line holds: images are written a line at a time.
constexpr int beams_at_once = 16;

/// A ping without an image, with what was counted and timed while it was traced.
Ping blank_ping(const TracedPing& traced, const View& view, const Terms& terms) {
    Ping ping;
    ping.range_bins = view.range_bins;
    ping.beams = view.beams;
    ping.estimated_l1 = traced.samples.estimated_l1;
    ping.counts = traced.counts;
    ping.seconds = traced.seconds;
    if (!terms.multipath) ping.counts.multipath = {};
    return ping;
}

/// Adds the echoes of the visible surface to the bins of a beam. Holds what all beams share.
struct DirectEchoes {
    const Scene& scene;
    const RangeBins& bins;
    const ScattererLattice& lattice;
    const RangeNoise& range_noise;
    PhiloxKey draws;
    Echoes echoes = {};  ///< of the samples that were added last

    /// Eq. 4-8. Returns how many echoes lie out of range.
    std::uint64_t add(std::span<const Sample> samples, BinSums& sums) {
        direct_echoes(samples, scene.materials, bins.bin_m, lattice, echoes);
        add_range_noise(echoes, range_noise, draws);
        return accumulate(echoes, bins, sums);
    }
};

/// Adds the multipath echoes of beam j to its bins. Returns how many lie out of range.
std::uint64_t accumulate_beam(const MultipathEchoes& bounced, int j, const RangeBins& bins,
                              BinSums& sums) {
    return accumulate(bounced.echoes, bounced.beam_begin[j], bounced.beam_begin[j + 1], bins, sums);
}

/// The image by the calibrated model. Its speckle is a random term of the echoes, as range noise
/// is, and its receiver's noise one of the pixels.
Ping form_calibrated_image(const TracedPing& traced, const PingSettings& settings,
                           const Scene& scene, const PingKey& key, const Terms& terms) {
    Ping ping = blank_ping(traced, settings.view, terms);
    Stopwatch watch;
    const auto draws = [&](std::uint32_t number, Stream s) {
        return stream_key(key.seed, settings.stream, number, s);
    };
    ping.intensity.resize(static_cast<std::size_t>(ping.range_bins) * ping.beams);
    const CalibratedCounts counts =
        form_calibrated(*settings.calibrated, {traced.samples, traced.mirrored, traced.beside},
                        scene, traced.T_world_sensor,
                        {.scene = stream_key(key.seed, 0, 0, Stream::scatterers),
                         .ping = draws(key.ping, Stream::speckle),
                         .noise = draws(key.ping, Stream::receiver_noise)},
                        {.echoes = terms.direct,
                         .mirrored = terms.multipath,
                         .speckle = terms.range_noise,
                         .noise = terms.pixel_noise},
                        ping.intensity);
    ping.counts.echoes = counts.echoes;
    ping.counts.out_of_range = counts.out_of_range;
    ping.counts.occupied_bins = counts.lit_places;
    ping.seconds.accumulate = watch.lap();
    return ping;
}

}  // namespace

TracedPing trace_ping(const PingSettings& settings, const Scene& scene,
                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                      const Terms& terms) {
    TracedPing traced;
    traced.T_world_sensor = T_world_sensor;
    Stopwatch watch;

    // 1. The visible surface.
    HeardSurface heard =
        heard_surface(settings.view, settings.beams_beside, engine, T_world_sensor);
    traced.samples = std::move(heard.samples);
    traced.beside = std::move(heard.beside);
    traced.counts.samples = traced.samples.items.size() + traced.beside.size();
    traced.counts.dropped_samples = traced.samples.dropped;
    traced.seconds.trace = watch.lap();

    // 2. Multipath, Eq. 1-3.
    if (terms.multipath) trace_multipath(settings, scene, engine, traced);
    return traced;
}

void trace_multipath(const PingSettings& settings, const Scene& scene,
                     const VisibilityEngine& engine, TracedPing& traced) {
    Stopwatch watch;
    traced.counts.multipath = {};
    traced.bounces.clear();
    traced.mirrored.clear();
    if (settings.multipath.on) {
        traced.bounces =
            find_bounces(settings.multipath, settings.view, traced.samples, scene.materials, engine,
                         traced.T_world_sensor, traced.counts.multipath, scene.water_surface,
                         settings.calibrated ? &traced.mirrored : nullptr);
    }
    traced.seconds.multipath = watch.lap();
}

Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms) {
    if (settings.calibrated) return form_calibrated_image(traced, settings, scene, key, terms);
    const RangeBins bins = range_bins(settings.view);
    const RangeNoise range_noise = terms.range_noise ? settings.range_noise : RangeNoise{};
    const Streaks streaks = terms.streaks ? settings.streaks : Streaks{};
    const ScattererLattice lattice = scatterer_lattice(range_noise, scene, traced.T_world_sensor);
    const auto draws = [&](Stream s) { return stream_key(key.seed, settings.stream, key.ping, s); };
    Ping ping = blank_ping(traced, settings.view, terms);
    Stopwatch watch;

    // 3, 4. The echoes of the multipath and their range noise.
    const auto bounces =
        std::span(traced.bounces).first(terms.multipath ? traced.bounces.size() : 0);
    MultipathEchoes bounced = multipath_echoes(bounces, traced.samples, settings.view, lattice);
    add_range_noise(bounced.echoes, range_noise, draws(Stream::multipath_range_noise));
    ping.counts.echoes = bounced.echoes.size();

    // 3, 4, 5. Beam by beam the same for the visible surface, Eq. 4-8; the mean of bins, Eq. 9.
    DirectEchoes direct{scene, bins, lattice, range_noise, draws(Stream::range_noise)};
    ping.intensity.resize(static_cast<std::size_t>(bins.count) * ping.beams);
    std::vector<float> by_beam(static_cast<std::size_t>(std::min(ping.beams, beams_at_once)) *
                               bins.count);
    RowAreas areas(bins.count);
    BinSums sums;
    for (int j = 0; j < ping.beams; ++j) {
        sums.clear(bins.count);
        if (terms.direct) {
            ping.counts.out_of_range += direct.add(traced.samples.beam(j), sums);
            ping.counts.echoes += direct.echoes.size();
        }
        if (streaks.exist()) {
            areas.add(sums);
            direct.add(at_normal_incidence(traced.samples.beam(j), streaks.least_cosine),
                       areas.normal);
        }
        ping.counts.out_of_range += accumulate_beam(bounced, j, bins, sums);
        const int column = j % beams_at_once;
        ping.counts.occupied_bins += mean_of_bins(
            sums,
            std::span(by_beam).subspan(static_cast<std::size_t>(column) * bins.count, bins.count));
        if (column + 1 == beams_at_once || j + 1 == ping.beams) {
            write_beams(by_beam, column + 1, j - column, ping.beams, ping.intensity);
        }
    }
    ping.seconds.accumulate = watch.lap();

    // 6. Pixel noise, Eq. 10-13. 7. Streaks, Eq. 14-15.
    if (terms.pixel_noise) {
        ping.counts.negative_pixels =
            add_pixel_noise(ping.intensity, settings.pixel_noise, draws(Stream::pixel_noise));
    }
    if (streaks.exist()) ping.counts.streak_rows = add_streaks(ping.intensity, areas, streaks);
    ping.seconds.noise = watch.lap();
    return ping;
}

}  // namespace sonarsim
