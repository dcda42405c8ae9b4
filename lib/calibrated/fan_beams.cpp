#include "calibrated/fan_beams.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace sonarsim {

namespace {

LineArray receiving_array(const BeamConfig& beam) {
    LineArray array = line_array(radians(beam.width_deg), beam.side_lobe_db);
    array.quadratic_rad = beam.aberration_rad[0];
    array.cubic_rad = beam.aberration_rad[1];
    array.quartic_rad = beam.aberration_rad[2];
    return array;
}

/// Where an echo goes: its place, and its shares in the next bin and the next column.
struct Target {
    float* place;
    float next_row, next_column;
};

Target target_of(const PointEchoes& echoes, int k, EchoGrid& grid) {
    const float row = std::floor(echoes.row[k]);
    const float column = std::floor(echoes.column[k]);
    return {grid.column(static_cast<int>(column)) + std::ptrdiff_t{2} * static_cast<int>(row),
            echoes.row[k] - row, echoes.column[k] - column};
}

/// Adds (a, b) to four places, a and b being the two floats of one.
void add_shared(const Target& target, __m128 value, std::size_t stride) {
    const __m128 rows = _mm_setr_ps(1.0F - target.next_row, 1.0F - target.next_row, target.next_row,
                                    target.next_row);
    const __m128 next = _mm_set1_ps(target.next_column);
    const __m128 whole = _mm_mul_ps(value, rows);
    const __m128 there = _mm_mul_ps(whole, next);
    float* const here = target.place;
    _mm_storeu_ps(here, _mm_add_ps(_mm_loadu_ps(here), _mm_sub_ps(whole, there)));
    _mm_storeu_ps(here + stride, _mm_add_ps(_mm_loadu_ps(here + stride), there));
}

/// Writes 8 bins of all beams into rows of the image, each times its gain.
void write_rows(const std::vector<Lanes>& beams, int row, std::span<const float> row_gain,
                std::span<float> image, bool add) {
    const int count = std::min(lanes_at_once, static_cast<int>(row_gain.size()) - row);
    for (int lane = 0; lane < count; ++lane) {
        const float gain = row_gain[row + lane];
        float* const out = image.data() + (row + lane) * beams.size();
        for (std::size_t j = 0; j < beams.size(); ++j)
            out[j] = std::fma(gain, beams[j][lane], add ? out[j] : 0.0F);
    }
}

void form_beams(const Beamformer& former, const EchoGrid* grid, const ElementNoise& noise,
                PhiloxKey key, std::span<const float> row_gain, std::span<float> image, bool add) {
    Beamformer::Scratch scratch(former);
    std::vector<Lanes> beams(former.beams());
    for (int row = 0; row < std::ssize(row_gain); row += lanes_at_once) {
        former.form(grid, row, noise, key, scratch, beams.data());
        write_rows(beams, row, row_gain, image, add);
    }
}

}  // namespace

FanBeams fan_beams(const BeamConfig& beam, const std::vector<double>& beam_sines, double noise,
                   double common_mode) {
    const LineArray array = receiving_array(beam);
    FanBeams out{.amplitudes = Beamformer(array, beam_sines, false),
                 .powers = Beamformer(array, beam_sines, true),
                 .noise = {}};
    out.noise.element_sigma =
        static_cast<float>(std::sqrt(noise)) * out.amplitudes.element_sigma_of_unit();
    out.noise.common_mode_sigma = static_cast<float>(std::sqrt(0.5 * common_mode));
    return out;
}

std::uint64_t find_columns(const FanBeams& beams, const PieceBlock& pieces, PointEchoes& echoes) {
    const SineGrid& grid = beams.amplitudes.grid();
    const auto per_step = static_cast<float>(1.0 / grid.step);
    const auto first_sine = static_cast<float>(grid.first);
    const auto last_column = static_cast<float>(grid.columns - 1);
    int outside = 0;
    for (int k = 0; k < echoes.count; ++k) {
        const float inverse = 1.0F / echoes.range_m[k];
        const float column = (pieces.y[k] * inverse - first_sine) * per_step;
        const bool inside = column >= 0.0F && column < last_column;
        outside += echoes.power[k] > 0.0F && !inside ? 1 : 0;
        echoes.power[k] = inside ? echoes.power[k] : 0.0F;
        echoes.column[k] = inside ? column : 0.0F;
    }
    return outside;
}

void add_powers(const FanBeams& /*beams*/, const PieceBlock& /*pieces*/, const PointEchoes& echoes,
                EchoGrid& grid) {
    for (int k = 0; k < echoes.count; ++k) {
        const __m128 value = _mm_setr_ps(echoes.power[k], 0.0F, echoes.power[k], 0.0F);
        add_shared(target_of(echoes, k, grid), value, grid.stride());
    }
}

void add_amplitudes(const FanBeams& /*beams*/, const PieceBlock& /*pieces*/,
                    const PointEchoes& echoes, const Amplitudes& amplitudes, EchoGrid& grid) {
    const auto& [re, im] = amplitudes;
    for (int k = 0; k < echoes.count; ++k) {
        const __m128 value = _mm_setr_ps(re[k], im[k], re[k], im[k]);
        add_shared(target_of(echoes, k, grid), value, grid.stride());
    }
}

void receive(const FanBeams& beams, const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
             std::span<const float> row_gain, std::span<float> image) {
    const ElementNoise noise = noisy ? beams.noise : ElementNoise{};
    if (!powers) {
        form_beams(beams.amplitudes, &grid, noise, key, row_gain, image, false);
        return;
    }
    form_beams(beams.powers, &grid, {}, {}, row_gain, image, false);
    if (noisy) form_beams(beams.amplitudes, nullptr, noise, key, row_gain, image, true);
}

}  // namespace sonarsim
