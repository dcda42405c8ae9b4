#include "simulate/paper/paper_model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/units.h"
#include "simulate/paper/echoes.h"
#include "simulate/paper/multipath_echoes.h"

namespace sonarsim {

namespace {

/// Fills an image [rows, columns] column by column, as many at a time as a cache line holds floats.
class ImageColumns {
  public:
    ImageColumns(int rows, int columns, std::span<float> image)
        : rows_(rows),
          columns_(columns),
          image_(image),
          pending_(static_cast<std::size_t>(std::min(columns, at_once)) * rows) {}

    /// The next column, to be filled before write().
    std::span<float> next() {
        return std::span(pending_).subspan(static_cast<std::size_t>(count_) * rows_, rows_);
    }
    /// Takes the column that next() returned, and writes full cache lines into the image.
    void write() {
        ++count_;
        if (count_ < at_once && written_ + count_ < columns_) return;
        write_beams(pending_, count_, written_, columns_, image_);
        written_ += count_;
        count_ = 0;
    }

  private:
    static constexpr int at_once = 16;

    int rows_, columns_;
    std::span<float> image_;
    std::vector<float> pending_;
    int count_ = 0;    ///< columns in `pending_`
    int written_ = 0;  ///< columns in `image_`
};

// In the order in which they enter an image.
constexpr std::array<std::string_view, 3> terms_by_name{"range_noise", "pixel_noise", "streaks"};
enum Term : std::size_t { range_noise_term, pixel_noise_term, streaks_term };

/// Adds the echoes of the visible surface to the bins of a beam. All beams share one.
struct DirectEchoes {
    const Scene& scene;
    const RangeBins& bins;
    const ScattererLattice& lattice;
    const RangeNoise& range_noise;
    PhiloxKey draws;
    Echoes echoes = {};  ///< the samples that were added last

    /// Eq. 4-8. Returns the number of echoes out of range.
    std::uint64_t add(std::span<const Sample> samples, BinSums& sums) {
        direct_echoes(samples, scene.materials, bins.bin_m, lattice, echoes);
        add_range_noise(echoes, range_noise, draws);
        return accumulate(echoes, bins, sums);
    }
};

/// Adds the multipath echoes of beam j to its bins. Returns the number out of range.
std::uint64_t accumulate_beam(const MultipathEchoes& bounced, int j, const RangeBins& bins,
                              BinSums& sums) {
    return accumulate(bounced.echoes, bounced.beam_begin[j], bounced.beam_begin[j + 1], bins, sums);
}

}  // namespace

void PaperModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    const Terms& terms = context.terms;
    const RangeBins bins = range_bins(context.view);
    const RangeNoise noise = terms.random > range_noise_term ? range_noise : RangeNoise{};
    const Streaks wanted_streaks = terms.random > streaks_term ? streaks : Streaks{};
    const ScattererLattice lattice = scatterer_lattice(noise, context.scene, traced.T_world_sensor);
    Stopwatch watch;

    // 3, 4. The echoes of the multipath and their range noise.
    const auto bounces =
        std::span(traced.bounces).first(terms.multipath ? traced.bounces.size() : 0);
    MultipathEchoes bounced = multipath_echoes(bounces, traced.starts(), context.view, lattice);
    add_range_noise(bounced.echoes, noise, context.draws.of(Stream::multipath_range_noise));
    ping.counts.echoes = bounced.echoes.size();

    // 3, 4, 5. By beam: the same for the visible surface, Eq. 4-8; the mean of bins, Eq. 9.
    DirectEchoes direct{context.scene, bins, lattice, noise, context.draws.of(Stream::range_noise)};
    ImageColumns columns(bins.count, ping.beams, ping.intensity);
    RowAreas areas(bins.count);
    BinSums sums;
    for (int j = 0; j < ping.beams; ++j) {
        sums.clear(bins.count);
        if (terms.direct) {
            ping.counts.out_of_range += direct.add(traced.samples.beam(j), sums);
            ping.counts.echoes += direct.echoes.size();
        }
        if (wanted_streaks.exist()) {
            areas.add(sums);
            direct.add(at_normal_incidence(traced.samples.beam(j), wanted_streaks.min_cosine),
                       areas.normal);
        }
        ping.counts.out_of_range += accumulate_beam(bounced, j, bins, sums);
        ping.counts.occupied_bins += mean_of_bins(sums, columns.next());
        columns.write();
    }
    ping.seconds.accumulate = watch.lap();

    // 6. Pixel noise, Eq. 10-13.
    if (terms.random > pixel_noise_term) {
        ping.counts.negative_pixels =
            add_pixel_noise(ping.intensity, pixel_noise, context.draws.of(Stream::pixel_noise));
    }
    // 7. Streaks, Eq. 14-15.
    if (wanted_streaks.exist())
        ping.counts.streak_rows = add_streaks(ping.intensity, areas, wanted_streaks);
    ping.seconds.noise = watch.lap();
}

PaperModel paper_model(const SonarConfig& config, const PaperSonar& sonar) {
    const NoiseConfig& noise = config.noise;
    PaperModel model;
    model.streaks = {
        .mode = config.streaks.mode,
        .threshold = static_cast<float>(config.streaks.threshold),
        .min_cosine = static_cast<float>(sincos(radians(config.streaks.angle_deg)).cos)};
    model.range_noise = {.lambda_m = static_cast<float>(noise.range_lambda_m),
                         .scatterer_m = static_cast<float>(noise.scatterer_m),
                         .fades = sonar.range_noise_fades};
    model.pixel_noise = {.gain = static_cast<float>(noise.gain > 0.0 ? noise.gain : sonar.gain),
                         .add_sigma = static_cast<float>(noise.add_sigma),
                         .mult_sigma = static_cast<float>(noise.mult_sigma),
                         .range_scale = sonar.range_scale,
                         .lobe_scale = std::vector<float>(sonar.beams, 1.0F)};
    model.info.random_terms = terms_by_name;
    model.info.noise_growth = sonar.range_scale;
    if (!noise.scale_with_range) return model;
    const double sigma =
        radians(noise.lobe_sigma_deg > 0.0 ? noise.lobe_sigma_deg : config.azimuth_deg / 8.0);
    for (std::size_t j = 0; j < sonar.beam_azimuths_rad.size(); ++j) {
        const double phi = sonar.beam_azimuths_rad[j];
        // The narrowest lobes that a mission may set underflow to 0 in radians.
        const double sigmas = phi == 0.0 ? 0.0 : phi / sigma;
        model.pixel_noise.lobe_scale[j] =
            static_cast<float>(1.0 + 0.5 * exponential(-0.5 * sigmas * sigmas));
    }
    return model;
}

EchoModel::SignalAndNoise PaperModel::signal_and_noise(float clean, float /*noisy*/, int range_bin,
                                                       int beam) const {
    constexpr double deviation_of_rayleigh = 0.6551363775620335;  // sqrt(2 - pi / 2)
    return {pixel_noise.gain * clean, deviation_of_rayleigh * pixel_noise.add_sigma *
                                          pixel_noise.range_scale[range_bin] *
                                          pixel_noise.lobe_scale[beam]};
}

}  // namespace sonarsim
