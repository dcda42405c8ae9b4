#include "simulate/paper/paper_model.h"

#include <xmmintrin.h>

#include <array>
#include <cstddef>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/units.h"
#include "simulate/paper/echoes.h"

namespace sonarsim {

namespace {

/// The area-weighted mean of each bin, Eq. 9; 0 in bins without surface. Returns how many have it.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity) {
    int occupied = 0;
    const auto first = static_cast<std::size_t>(sums.first);
    const auto end = static_cast<std::size_t>(sums.end);
    std::fill(intensity.begin(), intensity.begin() + sums.first, 0.0F);
    std::fill(intensity.begin() + sums.end, intensity.end(), 0.0F);
    for (std::size_t i = first; i < end; ++i) {
        const float weight = sums.weight(i);
        const bool visible = weight > 0.0F;
        intensity[i] = visible ? sums.echo(i) / weight : 0.0F;
        occupied += visible ? 1 : 0;
    }
    return occupied;
}

constexpr int tile = 4;

/// Writes the first 4 values of 4 lists, `from_step` apart, as columns of 4 rows, `to_step` apart.
void write_transposed(const float* from, std::size_t from_step, float* to, std::size_t to_step) {
    __m128 a = _mm_loadu_ps(from);
    __m128 b = _mm_loadu_ps(from + from_step);
    __m128 c = _mm_loadu_ps(from + 2 * from_step);
    __m128 d = _mm_loadu_ps(from + 3 * from_step);
    _MM_TRANSPOSE4_PS(a, b, c, d);
    _mm_storeu_ps(to, a);
    _mm_storeu_ps(to + to_step, b);
    _mm_storeu_ps(to + 2 * to_step, c);
    _mm_storeu_ps(to + 3 * to_step, d);
}

/// Writes the means of `beams` beams, `by_beam` [beams, range bins], into as many columns of
/// `image`, [range bins, columns], from the column `first` on.
void write_beams(std::span<const float> by_beam, int beams, int first, int columns,
                 std::span<float> image) {
    const std::size_t rows = image.size() / columns;
    const std::size_t whole_rows = rows / tile * tile;
    const int whole_beams = beams / tile * tile;
    float* const to = image.data() + first;
    for (std::size_t i = 0; i < whole_rows; i += tile) {
        for (int j = 0; j < whole_beams; j += tile)
            write_transposed(by_beam.data() + j * rows + i, rows, to + i * columns + j, columns);
    }
    for (std::size_t i = 0; i < rows; ++i) {
        for (int j = i < whole_rows ? whole_beams : 0; j < beams; ++j)
            to[i * columns + j] = by_beam[j * rows + i];
    }
}

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

    /// Eq. 4-8; with `min_cosine` the parts at normal incidence. Returns the number out of range.
    std::uint64_t add(std::span<const Sample> samples, BinSums& sums, float min_cosine = 0.0F) {
        std::vector<std::uint32_t> ends;
        direct_echoes(samples, scene.materials, bins.bin_m, lattice, echoes, &ends);
        if (min_cosine > 0.0F) cut_to_normal_incidence(samples, ends, min_cosine, echoes);
        add_range_noise(echoes, range_noise, draws);
        return accumulate(echoes, bins, sums);
    }
};

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
            const float cosine = wanted_streaks.min_cosine;
            direct.add(near_normal_incidence(traced.samples.beam(j), cosine), areas.normal, cosine);
        }
        ping.counts.out_of_range += accumulate(bounced.echoes, bounced.beam_begin[j],
                                               bounced.beam_begin[j + 1], bins, sums);
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
    const double sigma = radians(config.azimuth_deg / 8.0);
    for (std::size_t j = 0; j < sonar.beam_azimuths_rad.size(); ++j) {
        const double sigmas = sonar.beam_azimuths_rad[j] / sigma;
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
