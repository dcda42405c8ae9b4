#include "core/decibel.h"
#include "core/units.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/filtered_noise.h"
#include "simulate/calibrated/signal/line_array.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr float lobe_ends = 0.01F;  // two-way power, a share of that on the axis

void add_between_bins(float* column, float row, float re, float im) {
    const float whole = std::floor(row);
    const float next = row - whole;
    float* const place = column + static_cast<std::ptrdiff_t>(2) * static_cast<int>(whole);
    place[0] = std::fma(1.0F - next, re, place[0]);
    place[1] = std::fma(1.0F - next, im, place[1]);
    place[2] = std::fma(next, re, place[2]);
    place[3] = std::fma(next, im, place[3]);
}

class TransducerBeams final : public Beams {
  public:
    TransducerBeams(const BeamConfig& beam, const View& view, double wavelength_m,
                    std::span<const double> noise, const std::vector<float>& taps)
        : aperture_(beam.aperture), noise_taps_(taps) {
        for (const double power : noise)
            row_sigma_.push_back(static_cast<float>(std::sqrt(0.5 * power)));
        if (beam.aperture == Aperture::piston) {
            const double scale = piston_scale(radians(beam.width_deg));
            pattern_ = sine_table(0.0, sincos(0.5 * view.elevation_rad).sin, [&](double sine) {
                const double one_way = piston_pattern(scale * sine);
                return one_way * one_way;
            });
            return;
        }
        if (beam.aperture == Aperture::head) {
            const LineArray across = line_array(radians(beam.width_deg), beam.side_lobe_db);
            const double end = sincos(0.5 * view.azimuth_rad).sin;
            const PatternWithErrors pattern(across, beam.elements);
            pattern_ = sine_table(-end, end, [&](double sine) { return std::norm(pattern(sine)); });
            return;
        }
        const SinCos tilt = sincos(radians(beam.tilt_deg));
        const auto down = static_cast<float>(tilt.sin);
        const auto out_to_port = static_cast<float>(tilt.cos);
        sides_ = {{down, -out_to_port}, {down, out_to_port}};
        along_ =
            unfocused_beam(line_array(radians(beam.width_deg), beam.side_lobe_db), wavelength_m,
                           view.range_min_m, sincos(0.5 * view.elevation_rad).sin);
        const LineArray across = line_array(radians(beam.across_width_deg), 0.0);
        const double floor = power_of_db(beam.lobe_floor_db);
        pattern_ = sine_table(-1.0, 1.0, [&](double sine) {
            const double one_way = line_pattern(across, sine);
            return std::sqrt(one_way * one_way * one_way * one_way + floor);
        });
    }

    int columns() const override { return sides_.empty() ? 1 : static_cast<int>(sides_.size()); }

    void deposit(const PatchBlock& pieces, const PointEchoes& echoes, const Amplitudes* amplitudes,
                 EchoGrid& grid, EchoGrid* mean) const override {
        Amplitudes weights;
        for (int beam = 0; beam < columns(); ++beam) {
            find_weights(beam, pieces, echoes, weights);
            for (int k = 0; k < pieces.count; ++k) {
                const float re = weights.re[k];
                const float im = weights.im[k];
                if (re == 0.0F && im == 0.0F) continue;
                const float power = echoes.power[k] * std::fma(re, re, im * im);
                if (mean) add_between_bins(mean->column(beam), echoes.row[k], power, 0.0F);
                if (!amplitudes) {
                    add_between_bins(grid.column(beam), echoes.row[k], power, 0.0F);
                    continue;
                }
                const float a = amplitudes->re[k];
                const float b = amplitudes->im[k];
                // Explicit fma(): GCC contracts two adjacent products in any case, others do not.
                add_between_bins(grid.column(beam), echoes.row[k], std::fma(a, re, -(b * im)),
                                 std::fma(a, im, b * re));
            }
        }
    }

    void deposit_paths(const PathEndpoint& out, const PathEndpoint& back,
                       EchoGrid& grid) const override {
        PatchBlock::Array<float> sent;
        PatchBlock::Array<float> received;
        for (int beam = 0; beam < columns(); ++beam) {
            find_gains(beam, out.places, out.echoes, sent);
            find_gains(beam, back.places, back.echoes, received);
            for (int k = 0; k < back.places.count; ++k) {
                // Gains are two-way, the square of one way.
                const float gain = std::sqrt(sent[k] * received[k]);
                add_between_bins(grid.column(beam), back.echoes.row[k], back.echoes.power[k] * gain,
                                 0.0F);
            }
        }
    }

    void find_gains(int beam, const PatchBlock& pieces, const PointEchoes& echoes,
                    PatchBlock::Array<float>& gains) const override {
        Amplitudes weights;
        find_weights(beam, pieces, echoes, weights);
        for (int k = 0; k < pieces.count; ++k)
            gains[k] = std::fma(weights.re[k], weights.re[k], weights.im[k] * weights.im[k]);
    }

    void find_received(const PatchBlock& pieces, const PointEchoes& echoes, const PathEndpoint* out,
                       std::vector<ReceivedPiece>& received) const override {
        PatchBlock::Array<float> sent;
        PatchBlock::Array<float> gains;
        for (int beam = 0; beam < columns(); ++beam) {
            find_gains(beam, pieces, echoes, gains);
            if (out) find_gains(beam, out->places, out->echoes, sent);
            for (int k = 0; k < pieces.count; ++k) {
                // A gain is that of both ways.
                const float gain = out ? std::sqrt(sent[k] * gains[k]) : gains[k];
                const float power = echoes.power[k] * gain;
                if (power > 0.0F && in_main_lobe(pieces, echoes, k))
                    received.push_back({beam, k, power});
            }
        }
    }

    double mean_along_track(const View& view, double range_m) const override {
        if (sides_.empty()) return 1.0;
        const double up = sincos(std::min(0.5 * view.elevation_rad, 0.5 * pi)).sin;
        constexpr int steps = 512;
        double sum = 0.0;
        for (int k = 0; k < steps; ++k) {
            const double sine = up * ((2.0 * k + 1.0) / steps - 1.0);
            sum += std::norm(along_.at(static_cast<float>(sine), static_cast<float>(range_m)));
        }
        return sum / steps;
    }

    void form(const EchoGrid& grid, bool powers, bool noisy, PhiloxKey key,
              std::span<const float> row_gain, std::span<float> image) const override {
        const int count = columns();
        FilteredNoise noise({.firsts = count}, noise_taps_, key);
        for (int row = 0; row < grid.rows(); row += lanes) {
            if (noisy) noise.go_to(row);
            const int filled = std::min(lanes, grid.rows() - row);
            for (int beam = 0; beam < count; ++beam) {
                const float* const column = grid.column(beam);
                const auto [re, im] = noisy ? noise.of(beam) : ComplexLanes{};
                for (int lane = 0; lane < filled; ++lane) {
                    const std::ptrdiff_t at = std::ptrdiff_t{2} * (row + lane);
                    const float sigma = noisy ? row_sigma_[row + lane] : 0.0F;
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

  private:
    struct Axis {
        float x, y;  ///< unit, sensor frame
    };

    /// The two-way complex amplitudes of one beam for every piece.
    void find_weights(int beam, const PatchBlock& pieces, const PointEchoes& echoes,
                      Amplitudes& out) const {
        for (int k = 0; k < pieces.count; ++k) {
            const float x = pieces.x[k];
            const float y = pieces.y[k];
            const float z = pieces.z[k];
            const float range = echoes.range_m[k];
            if (sides_.empty()) {
                const bool disc = aperture_ == Aperture::piston;
                const float off = disc ? std::sqrt(std::fma(y, y, z * z)) : y;
                out.re[k] = pattern_.at(piece_sine(off, range));
                out.im[k] = 0.0F;
                continue;
            }
            const Axis axis = sides_[beam];
            if (!(std::fma(x, axis.x, y * axis.y) > 0.0F)) {
                out.re[k] = out.im[k] = 0.0F;
                continue;
            }
            const float across = piece_sine(y * axis.x - x * axis.y, range);
            const std::complex<float> along = along_.at(piece_sine(z, range), range);
            const float weight = pattern_.at(across);
            out.re[k] = weight * along.real();
            out.im[k] = weight * along.imag();
        }
    }

    /// True if a piece lies in the main lobe of the narrow pattern: of a side along the track, of a
    /// head in azimuth. A disc has no narrow pattern. The main lobe ends at -20 dB two-way: the
    /// highest side lobe of an even line array has -26.5 dB.
    bool in_main_lobe(const PatchBlock& pieces, const PointEchoes& echoes, int k) const {
        const float range = echoes.range_m[k];
        const auto reaches = [](std::complex<float> amplitude, std::complex<float> on_axis) {
            return std::norm(amplitude) >= lobe_ends * std::norm(on_axis);
        };
        if (!sides_.empty())
            return reaches(along_.at(piece_sine(pieces.z[k], range), range),
                           along_.at(0.0F, range));
        if (aperture_ == Aperture::piston) return true;
        return reaches(pattern_.at(piece_sine(pieces.y[k], range)), pattern_.at(0.0F));
    }

    Aperture aperture_;
    std::vector<Axis> sides_;  ///< starboard and port; empty: one beam, along the boresight
    UnfocusedBeam along_;      ///< pattern of a side along the sensor's z axis, two-way
    /// Two-way amplitude of a side across the track, of a disc off its axis, of a head in azimuth.
    SineTable pattern_;
    /// [range bins, to a multiple of 8] of the noise, real and imaginary part each.
    std::vector<float> row_sigma_;
    std::vector<float> noise_taps_;
};

}  // namespace

std::shared_ptr<const Beams> transducer_beams(const BeamConfig& beam, const View& view,
                                              double wavelength_m, std::span<const double> noise,
                                              const std::vector<float>& taps) {
    return std::make_shared<TransducerBeams>(beam, view, wavelength_m, noise, taps);
}

}  // namespace sonarsim
