#include "simulate/calibrated/transducer_beams.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/element_errors.h"
#include "simulate/calibrated/filtered_noise.h"
#include "simulate/calibrated/levels.h"
#include "simulate/calibrated/piston.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr float lobe_ends = 0.01F;  // two-way power, a share of that on the axis

/// The two-way complex amplitudes of one beam for every piece.
void find_weights(const TransducerBeams& beams, int beam, const PatchBlock& pieces,
                  const PointEchoes& echoes, Amplitudes& out) {
    for (int k = 0; k < pieces.count; ++k) {
        const float x = pieces.x[k];
        const float y = pieces.y[k];
        const float z = pieces.z[k];
        const float range = echoes.range_m[k];
        if (beams.sides.empty()) {
            const bool disc = beams.aperture == Aperture::piston;
            const float off = disc ? std::sqrt(std::fma(y, y, z * z)) : y;
            out.re[k] = beams.pattern.at(piece_sine(off, range));
            out.im[k] = 0.0F;
            continue;
        }
        const TransducerBeams::Axis axis = beams.sides[beam];
        if (!(std::fma(x, axis.x, y * axis.y) > 0.0F)) {
            out.re[k] = out.im[k] = 0.0F;
            continue;
        }
        const float across = piece_sine(y * axis.x - x * axis.y, range);
        const std::complex<float> along = beams.along.at(piece_sine(z, range), range);
        const float weight = beams.pattern.at(across);
        out.re[k] = weight * along.real();
        out.im[k] = weight * along.imag();
    }
}

void add_between_bins(float* column, float row, float re, float im) {
    const float whole = std::floor(row);
    const float next = row - whole;
    float* const place = column + static_cast<std::ptrdiff_t>(2) * static_cast<int>(whole);
    place[0] = std::fma(1.0F - next, re, place[0]);
    place[1] = std::fma(1.0F - next, im, place[1]);
    place[2] = std::fma(next, re, place[2]);
    place[3] = std::fma(next, im, place[3]);
}

/// Calls use(beam, piece, weight) for the weights that are not 0.
template <class Use>
void for_each_weight(const TransducerBeams& beams, const PatchBlock& pieces,
                     const PointEchoes& echoes, Use use) {
    Amplitudes weights;
    for (int beam = 0; beam < beams.beams(); ++beam) {
        find_weights(beams, beam, pieces, echoes, weights);
        for (int k = 0; k < pieces.count; ++k) {
            if (weights.re[k] != 0.0F || weights.im[k] != 0.0F)
                use(beam, k, weights.re[k], weights.im[k]);
        }
    }
}

}  // namespace

TransducerBeams transducer_beams(const BeamConfig& beam, const View& view, double wavelength_m,
                                 std::span<const double> noise, const std::vector<float>& taps) {
    TransducerBeams out;
    out.noise_taps = taps;
    out.aperture = beam.aperture;
    for (const double power : noise)
        out.row_sigma.push_back(static_cast<float>(std::sqrt(0.5 * power)));
    if (beam.aperture == Aperture::piston) {
        const double scale = piston_scale(radians(beam.width_deg));
        out.pattern = sine_table(0.0, sincos(0.5 * view.elevation_rad).sin, [&](double sine) {
            const double one_way = piston_pattern(scale * sine);
            return one_way * one_way;
        });
        return out;
    }
    if (beam.aperture == Aperture::head) {
        const LineArray across = line_array(radians(beam.width_deg), beam.side_lobe_db);
        const double end = sincos(0.5 * view.azimuth_rad).sin;
        const PatternWithErrors pattern(across, beam.elements);
        out.pattern = sine_table(-end, end, [&](double sine) { return std::norm(pattern(sine)); });
        return out;
    }
    const SinCos tilt = sincos(radians(beam.tilt_deg));
    const auto down = static_cast<float>(tilt.sin);
    const auto out_to_port = static_cast<float>(tilt.cos);
    out.sides = {{down, -out_to_port}, {down, out_to_port}};
    out.along = unfocused_beam(line_array(radians(beam.width_deg), beam.side_lobe_db), wavelength_m,
                               view.range_min_m, sincos(0.5 * view.elevation_rad).sin);
    const LineArray across = line_array(radians(beam.across_width_deg), 0.0);
    const double floor = power_of_db(beam.lobe_floor_db);
    out.pattern = sine_table(-1.0, 1.0, [&](double sine) {
        const double one_way = line_pattern(across, sine);
        return std::sqrt(one_way * one_way * one_way * one_way + floor);
    });
    return out;
}

void add_powers(const TransducerBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                EchoGrid& grid) {
    for_each_weight(beams, pieces, echoes, [&](int beam, int k, float re, float im) {
        const float power = echoes.power[k] * std::fma(re, re, im * im);
        add_between_bins(grid.column(beam), echoes.row[k], power, 0.0F);
    });
}

void add_amplitudes(const TransducerBeams& beams, const PatchBlock& pieces,
                    const PointEchoes& echoes, const Amplitudes& amplitudes, EchoGrid& grid,
                    EchoGrid* mean) {
    for_each_weight(beams, pieces, echoes, [&](int beam, int k, float re, float im) {
        const float a = amplitudes.re[k];
        const float b = amplitudes.im[k];
        // Explicit fma(): GCC contracts two adjacent products even if contraction is switched
        // off, and other compilers do not.
        add_between_bins(grid.column(beam), echoes.row[k], std::fma(a, re, -(b * im)),
                         std::fma(a, im, b * re));
        if (!mean) return;
        const float power = echoes.power[k] * std::fma(re, re, im * im);
        add_between_bins(mean->column(beam), echoes.row[k], power, 0.0F);
    });
}

void find_gains(const TransducerBeams& beams, int beam, const PatchBlock& pieces,
                const PointEchoes& echoes, PatchBlock::Array<float>& gains) {
    Amplitudes weights;
    find_weights(beams, beam, pieces, echoes, weights);
    for (int k = 0; k < pieces.count; ++k)
        gains[k] = std::fma(weights.re[k], weights.re[k], weights.im[k] * weights.im[k]);
}

bool in_main_lobe(const TransducerBeams& beams, const PatchBlock& pieces, const PointEchoes& echoes,
                  int k) {
    const float range = echoes.range_m[k];
    const auto reaches = [](std::complex<float> amplitude, std::complex<float> on_axis) {
        return std::norm(amplitude) >= lobe_ends * std::norm(on_axis);
    };
    if (!beams.sides.empty())
        return reaches(beams.along.at(piece_sine(pieces.z[k], range), range),
                       beams.along.at(0.0F, range));
    if (beams.aperture == Aperture::piston) return true;
    return reaches(beams.pattern.at(piece_sine(pieces.y[k], range)), beams.pattern.at(0.0F));
}

void add_bistatic_powers(const TransducerBeams& beams, const PathEndpoint& out,
                         const PathEndpoint& back, EchoGrid& grid) {
    Amplitudes sent, received;
    const auto power_of = [](const Amplitudes& of, int k) {
        return std::fma(of.re[k], of.re[k], of.im[k] * of.im[k]);
    };
    for (int beam = 0; beam < beams.beams(); ++beam) {
        find_weights(beams, beam, out.places, out.echoes, sent);
        find_weights(beams, beam, back.places, back.echoes, received);
        for (int k = 0; k < back.places.count; ++k) {
            // Weights are two-way, the square of one way.
            const float weight = std::sqrt(power_of(sent, k) * power_of(received, k));
            add_between_bins(grid.column(beam), back.echoes.row[k], back.echoes.power[k] * weight,
                             0.0F);
        }
    }
}

void beamform(const TransducerBeams& beams, const EchoGrid& grid, bool powers, bool noisy,
              PhiloxKey key, std::span<const float> row_gain, std::span<float> image) {
    const int count = beams.beams();
    FilteredNoise noise({.firsts = count}, beams.noise_taps, key);
    for (int row = 0; row < grid.rows(); row += lanes) {
        if (noisy) noise.go_to(row);
        const int filled = std::min(lanes, grid.rows() - row);
        for (int beam = 0; beam < count; ++beam) {
            const float* const column = grid.column(beam);
            const auto [re, im] = noisy ? noise.of(beam) : ComplexLanes{};
            for (int lane = 0; lane < filled; ++lane) {
                const std::ptrdiff_t at = std::ptrdiff_t{2} * (row + lane);
                const float sigma = noisy ? beams.row_sigma[row + lane] : 0.0F;
                // Without speckle the energies of echo and noise add.
                const float x = sigma * re[lane] + (powers ? 0.0F : column[at]);
                const float y = sigma * im[lane] + (powers ? 0.0F : column[at + 1]);
                const float echo = powers ? std::max(column[at], 0.0F) : 0.0F;
                image[static_cast<std::size_t>(row + lane) * count + beam] =
                    value_of(row_gain[row + lane], echo + std::fma(x, x, y * y));
            }
        }
    }
}

}  // namespace sonarsim
