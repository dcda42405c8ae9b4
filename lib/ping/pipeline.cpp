#include "ping/pipeline.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "ping/accumulate.h"
#include "ping/echoes.h"
#include "ping/range_noise.h"

namespace sonarsim {

namespace {

/// Seconds since the last call.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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

Ping run_pipeline(const PingSettings& settings, const Scene& scene, const Surface& surface,
                  const Pose& T_world_sensor, const PingKey& key) {
    const View& view = settings.view;
    const RangeNoise& range_noise = settings.range_noise;
    const RangeBins bins{static_cast<float>(view.range_min_m), static_cast<float>(view.bin_m()),
                         view.range_bins};
    const ScattererLattice lattice = lattice_for(range_noise, scene, T_world_sensor);
    const auto stream = [&](Stream s) {
        return stream_key(key.seed, settings.stream, key.ping, s);
    };
    Ping ping{view.range_bins, view.beams, {}, {}, {}};
    ping.intensity.resize(static_cast<std::size_t>(view.range_bins) * view.beams);
    Stopwatch watch;

    Samples samples;
    surface.look(view, T_world_sensor, samples);
    ping.counts.samples = samples.items.size();
    ping.seconds.trace = watch.lap();

    std::vector<float> by_beam(ping.intensity.size());
    Echoes echoes;
    BinSums sums;
    for (int j = 0; j < view.beams; ++j) {
        sums.clear(bins.count);
        direct_echoes(samples.beam(j), scene.materials, bins.bin_m, lattice, echoes);
        if (lattice.exists()) {
            add_range_noise(echoes, range_noise.lambda_m, range_noise.fades,
                            stream(Stream::range_noise));
        }
        ping.counts.echoes += echoes.size();
        ping.counts.out_of_range += accumulate(echoes, bins, sums);
        const std::size_t column = static_cast<std::size_t>(j) * bins.count;
        ping.counts.occupied_bins +=
            mean_of_bins(sums, std::span(by_beam).subspan(column, bins.count));
    }
    transpose(by_beam, ping);
    ping.seconds.accumulate = watch.lap();

    ping.counts.negative_pixels =
        add_pixel_noise(ping.intensity, settings.pixel_noise, stream(Stream::pixel_noise));
    ping.seconds.noise = watch.lap();
    return ping;
}

}  // namespace sonarsim
