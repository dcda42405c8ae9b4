#include "core/lanes.h"
#include "core/units.h"
#include "simulate/calibrated/beams/beamformer.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

LineArray receiving_array(const BeamConfig& beam) {
    LineArray array = line_array(radians(beam.width_deg), beam.side_lobe_db);
    array.quadratic_rad = beam.aberration_rad[0];
    array.cubic_rad = beam.aberration_rad[1];
    array.quartic_rad = beam.aberration_rad[2];
    return array;
}

/// The phase at the ends of an array of the length L that is in focus at the range f, in the middle
/// of every 8 bins: pi L^2 / (4 lambda) (1 / r - 1 / f), by Fresnel's approximation. It is limited
/// to that which spreads an echo over half of the fan to either side.
std::vector<double> defocus(const LineArray& array, double focus_m, double wavelength_m,
                            const BeamSines& sines, const RangeBins& bins) {
    std::vector<double> out;
    if (!(focus_m > 0.0)) return out;
    const double length = array.wavelengths;
    const double max_phase = 0.25 * pi * length * (sines.edges.back() - sines.edges.front());
    for (int row = 0; row < bins.count; row += lanes) {
        const double range_m = bins.min_m + (row + 0.5 * lanes) * bins.bin_m;
        const double phase =
            0.25 * pi * length * length * wavelength_m * (1.0 / range_m - 1.0 / focus_m);
        out.push_back(std::clamp(phase, -max_phase, max_phase));
    }
    return out;
}

/// Adds the first two floats of `values`. One cell at a time: neighbouring echoes share cells, and
/// a processor waits if it reads half of a value that it has just written.
void add_two(float* to, __m128 values) {
    auto* const place = reinterpret_cast<__m128i*>(to);
    const __m128 before = _mm_castsi128_ps(_mm_loadl_epi64(place));
    _mm_storel_epi64(place, _mm_castps_si128(_mm_add_ps(before, values)));
}

/// The cells of the grid for a block's echoes, and their shares in the next bin and column.
struct GridPlaces {
    PatchBlock::Array<std::int32_t> place;
    PatchBlock::Array<float> next_row, next_column;

    GridPlaces(const PointEchoes& echoes, const EchoGrid& grid) {
        const auto stride = static_cast<std::int32_t>(grid.stride());
        for (int k = 0; k < echoes.count; ++k) {
            const float row = std::floor(echoes.row[k]);
            const float column = std::floor(echoes.column[k]);
            place[k] =
                static_cast<std::int32_t>(column) * stride + 2 * static_cast<std::int32_t>(row);
            next_row[k] = echoes.row[k] - row;
            next_column[k] = echoes.column[k] - column;
        }
    }

    /// Adds (a, b, a, b) to the four cells around echo k; a and b are the two floats of a cell.
    void add_shared(int k, __m128 value, float* first, std::size_t stride) const {
        const __m128 rows =
            _mm_fmadd_ps(_mm_set1_ps(next_row[k]), _mm_setr_ps(-1.0F, -1.0F, 1.0F, 1.0F),
                         _mm_setr_ps(1.0F, 1.0F, 0.0F, 0.0F));
        const __m128 whole = _mm_mul_ps(value, rows);
        const __m128 there = _mm_mul_ps(whole, _mm_set1_ps(next_column[k]));
        const __m128 stays = _mm_sub_ps(whole, there);
        float* const here = first + place[k];
        add_two(here, stays);
        add_two(here + 2, _mm_movehl_ps(stays, stays));
        add_two(here + stride, there);
        add_two(here + stride + 2, _mm_movehl_ps(there, there));
    }
};

/// (a, b, a, b)
__m128 alternating(float a, float b) {
    return _mm_blend_ps(_mm_set1_ps(a), _mm_set1_ps(b), 0b1010);
}

/// `value_of`, 8 at a time.
Floats8 values_of(float gain, Floats8 power, Floats8 before) {
    // In this order of arguments NaN stays NaN.
    const Floats8 finite = min(std::numeric_limits<float>::max(), power);
    return min(max_value, fma(gain, finite, before));
}

/// Writes 8 bins of all beams into rows of the image, each times its gain.
void write_rows(const std::vector<Lanes>& beams, int row, std::span<const float> row_gain,
                std::span<float> image, bool add) {
    const int count = std::min(lanes, static_cast<int>(row_gain.size()) - row);
    float* const first = image.data() + row * beams.size();
    const std::size_t whole = beams.size() / lanes * lanes;
    for (std::size_t j = 0; j < whole; j += lanes) {
        const std::array<Floats8, lanes> bins = columns_of_eight(beams[j].data());
        for (int lane = 0; lane < count; ++lane) {
            float* const out = first + lane * beams.size() + j;
            values_of(row_gain[row + lane], bins[lane], add ? Floats8::load(out) : 0.0F).store(out);
        }
    }
    for (int lane = 0; lane < count; ++lane) {
        float* const out = first + lane * beams.size();
        for (std::size_t j = whole; j < beams.size(); ++j)
            out[j] = value_of(row_gain[row + lane], beams[j][lane], add ? out[j] : 0.0F);
    }
}

void form_beams(const Beamformer& former, const EchoGrid* grid, ElementNoise* noise,
                std::span<const float> row_gain, std::span<float> image, bool add) {
    Beamformer::Scratch scratch(former);
    std::vector<Lanes> beams(former.beams());
    for (int row = 0; row < std::ssize(row_gain); row += lanes) {
        former.form(grid, row, noise, scratch, beams.data());
        write_rows(beams, row, row_gain, image, add);
    }
}

class ArrayBeams final : public Beams {
  public:
    ArrayBeams(const LineArray& array, const BeamSines& sines, const ElementsConfig& errors,
               std::span<const double> phases, std::span<const double> noise,
               const std::vector<float>& taps)
        : amplitudes_(array, sines.middles, false, errors, phases),
          powers_(array, sines.middles, true, errors, phases),
          noise_taps_(taps) {
        cones = ConeBeams(sines.edges);
        for (const double power : noise) {
            row_sigma_.push_back(static_cast<float>(std::sqrt(power)) *
                                 amplitudes_.element_sigma_of_unit());
        }
    }

    int columns() const override { return sines()->columns; }
    const SineGrid* sines() const override { return &amplitudes_.grid(); }
    float scalloping_gain() const override { return amplitudes_.scalloping_gain(); }

    std::uint64_t find_columns(const PatchBlock& pieces, PointEchoes& echoes) const override {
        const SineGrid& grid = *sines();
        const auto per_step = static_cast<float>(1.0 / grid.step);
        const auto first_sine = static_cast<float>(grid.first);
        const auto last_column = static_cast<float>(grid.columns - 1);
        int outside = 0;
        for (int k = 0; k < echoes.count; ++k) {
            const float sine = piece_sine(pieces.y[k], echoes.range_m[k]);
            const float column = (sine - first_sine) * per_step;
            const bool inside = column >= 0.0F && column < last_column;
            outside += echoes.power[k] > 0.0F && !inside ? 1 : 0;
            echoes.power[k] = inside ? echoes.power[k] : 0.0F;
            echoes.column[k] = inside ? column : 0.0F;
        }
        return outside;
    }

    void deposit(const PatchBlock& /*pieces*/, const PointEchoes& echoes,
                 const Amplitudes* amplitudes, EchoGrid& grid, EchoGrid* mean) const override {
        const GridPlaces places(echoes, grid);
        const auto add = [&](EchoGrid& to, auto value_of_echo) {
            float* const first = to.column(0);
            const std::size_t stride = to.stride();
            for (int k = 0; k < echoes.count; ++k)
                places.add_shared(k, value_of_echo(k), first, stride);
        };
        const auto power = [&](int k) { return alternating(echoes.power[k], 0.0F); };
        if (mean) add(*mean, power);
        if (!amplitudes) return add(grid, power);
        add(grid, [&](int k) { return alternating(amplitudes->re[k], amplitudes->im[k]); });
    }

    void deposit_paths(const PathEndpoint& /*out*/, const PathEndpoint& back,
                       EchoGrid& grid) const override {
        deposit(back.places, back.echoes, nullptr, grid, nullptr);
    }

    void find_received(const PatchBlock& pieces, const PointEchoes& echoes,
                       const PathEndpoint* /*out*/,
                       std::vector<ReceivedPiece>& received) const override {
        for (int k = 0; k < pieces.count; ++k) {
            const float power = echoes.power[k];
            if (!(power > 0.0F)) continue;
            const float sine = piece_sine(pieces.y[k], echoes.range_m[k]);
            const float low = sine - pieces.half_sine[k];
            const float high = sine + pieces.half_sine[k];
            const auto add = [&](int beam, float share) {
                received.push_back({beam, k, share * power});
            };
            if (high > low)
                cones.for_each(low, high, add);
            else if (const int beam = cones.beam(sine); beam >= 0)
                add(beam, 1.0F);
        }
    }

    void form(const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
              std::span<const float> row_gain, std::span<float> image) const override {
        if (powers) form_beams(powers_, &grid, nullptr, row_gain, image, false);
        const EchoGrid* const amplitudes = powers ? nullptr : &grid;
        if (noisy) {
            ElementNoise noise = amplitudes_.noise_of_ping(row_sigma_, noise_taps_, key);
            form_beams(amplitudes_, amplitudes, &noise, row_gain, image, powers);
        } else if (amplitudes) {
            form_beams(amplitudes_, amplitudes, nullptr, row_gain, image, powers);
        }
    }

  private:
    Beamformer amplitudes_, powers_;
    std::vector<float> row_sigma_;   ///< [range bins, to a multiple of 8] of the elements' noise
    std::vector<float> noise_taps_;  ///< its filter along range
};

}  // namespace

std::shared_ptr<const Beams> array_beams(const BeamConfig& beam, const BeamSines& sines,
                                         const RangeBins& bins, double wavelength_m,
                                         std::span<const double> noise,
                                         const std::vector<float>& taps) {
    const LineArray array = receiving_array(beam);
    return std::make_shared<ArrayBeams>(array, sines, beam.elements,
                                        defocus(array, beam.focus_m, wavelength_m, sines, bins),
                                        noise, taps);
}

}  // namespace sonarsim
