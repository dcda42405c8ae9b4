#include "simulate/calibrated/speckle/speckle.h"

#include <algorithm>
#include <optional>

#include "core/elementary.h"
#include "core/lanes.h"
#include "simulate/calibrated/equation/seafloor_scattering.h"
#include "simulate/calibrated/signal/fourier.h"
#include "simulate/calibrated/signal/normals.h"

namespace sonarsim {

namespace {

void add_to_eight(float* cells, Floats8 re, Floats8 im) {
    std::array<float, std::size_t{2} * lanes> added;
    store_complex(re, im, added.data());
    (Floats8::load(cells) + Floats8::load(added.data())).store(cells);
    (Floats8::load(cells + lanes) + Floats8::load(added.data() + lanes)).store(cells + lanes);
}

constexpr double ln_per_db = 0.23025850929940457;  // ln(10) / 10
// Coordinates along the field are x and y plus this share of z, so that walls have texture, too.
constexpr float share_of_height = 0.7F;
// The coarse field moves the fine one by this times its value, so that nobody sees the fine one
// repeat. Slopes of the coarse field reach some 0.3 per m: waves are stretched by up to a half.
constexpr float bend_m = 1.5F;

double octave_db(const Material& material) {
    if (!is_sea_bed(material)) return 0.6;
    return std::max(0.0, 1.2 - 0.08 * (material.grain_phi.value_or(1.5) - 1.5));
}

/// Transforms the rows of a square of complex numbers back, and swaps rows and columns.
std::vector<std::complex<float>> rows_transformed(const std::vector<std::complex<float>>& square,
                                                  int size) {
    const Fourier fourier(size);
    std::vector<ComplexLanes> data(size), scratch(size);
    std::vector<std::complex<float>> out(square.size());
    for (int first = 0; first < size; first += lanes) {
        for (int k = 0; k < size; ++k) {
            for (int lane = 0; lane < lanes; ++lane) {
                const std::complex<float> value = square[(first + lane) * size + k];
                data[k].re[lane] = value.real();
                data[k].im[lane] = value.imag();
            }
        }
        fourier.backward(data.data(), scratch.data());
        for (int k = 0; k < size; ++k) {
            for (int lane = 0; lane < lanes; ++lane)
                out[k * size + first + lane] = {data[k].re[lane], data[k].im[lane]};
        }
    }
    return out;
}

/// A field with equal variance in each octave, in deviations of an octave. Variance in an octave
/// is the integral of the spectrum over k dk dphi, so the spectrum falls as k^-2. Waves have
/// the amplitude 1 / k and drawn phases, so the variance over the square is exact.
std::vector<float> make_field(const Texture::Square& square, std::uint32_t number) {
    const int size = square.size;
    const int shortest = 1 << square.octaves;  // waves along the edge
    std::vector<std::complex<float>> waves(static_cast<std::size_t>(size) * size);
    double variance = 0.0;
    for (int i = 0; i <= shortest; ++i) {
        for (int j = i > 0 ? -shortest : 1; j <= shortest; ++j) {  // half of the plane
            const int squared = i * i + j * j;
            if (squared > shortest * shortest) continue;
            const auto at = static_cast<std::uint32_t>(i * size + (j + size) % size);
            const SinCosFloat phase =
                sincos_turns(unit_float(philox({at, number, 0, 0}, {0, 0}).x0));
            const float amplitude = 1.0F / std::sqrt(static_cast<float>(squared));
            waves[at] = {amplitude * phase.cos, amplitude * phase.sin};
            variance += 0.5 / squared;
        }
    }
    const auto scale = static_cast<float>(std::sqrt(square.octaves / variance));
    const auto field = rows_transformed(rows_transformed(waves, size), size);
    std::vector<float> out;
    for (int i = 0; i <= size; ++i) {
        for (int j = 0; j <= size; ++j)
            out.push_back(scale * field[(i % size) * size + j % size].real());
    }
    return out;
}

/// The place along an axis of a square, in texels from 0 to its size, 8 at a time.
Floats8 texels(Floats8 metres, const Texture::Square& square, std::uint32_t moved) {
    const auto size = static_cast<float>(square.size);
    const Floats8 turns =
        fma(metres, static_cast<float>(1.0 / square.edge_m()),
            static_cast<float>(moved % static_cast<std::uint32_t>(square.size)) / size);
    return min((turns - floor(turns)) * size, size - 0.001F);
}

/// The field at places, linear between texels.
Floats8 field_at(const std::vector<float>& field, const Texture::Square& square, Floats8 u,
                 Floats8 v) {
    const Floats8 row = floor(u);
    const Floats8 column = floor(v);
    const int stride = square.size + 1;
    const Ints8 at = to_ints(row) * Ints8(stride) + to_ints(column);
    const auto [near_here, near_next] = table_entries(field.data(), at);
    const auto [far_here, far_next] = table_entries(field.data() + stride, at);
    const Floats8 along = v - column;
    const Floats8 here = fma(along, near_next - near_here, near_here);
    const Floats8 there = fma(along, far_next - far_here, far_here);
    return fma(u - row, there - here, here);
}

/// The places of pieces in the world, relative to Scene::origin, m.
struct WorldPlaces {
    PatchBlock::Array<float> x, y, z;
};

void find_places(const PatchBlock& pieces, int count, const SonarInScene& sonar, WorldPlaces& out) {
    const Eigen::Matrix3f& R = sonar.R_world_sensor;
    const Eigen::Vector3f s = sonar.sensor.cast<float>();
    const auto place = [&](int axis, PatchBlock::Array<float>& to) {
        const float rx = R(axis, 0);
        const float ry = R(axis, 1);
        const float rz = R(axis, 2);
        const float base = s[axis];
        for (int k = 0; k < count; ++k) {
            to[k] = std::fma(rx, pieces.x[k],
                             std::fma(ry, pieces.y[k], std::fma(rz, pieces.z[k], base)));
        }
    };
    place(0, out.x);
    place(1, out.y);
    place(2, out.z);
}

/// Moves places of straight sound and a sonar at rest to true ones, by the middle of the sample.
void move_to_true(std::span<const Sample> samples, const PatchBlock& pieces,
                  const TruePlaces& places, WorldPlaces& out) {
    const Sample* last = nullptr;
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();
    for (int k = 0; k < pieces.count; ++k) {
        const Sample& sample = samples[pieces.sample[k]];
        if (&sample != last) {
            const Eigen::Vector3d measured = sample.position.cast<double>();
            shift = (places.of(measured) - true_place(nullptr, places.T_world_sensor, measured))
                        .cast<float>();
            last = &sample;
        }
        out.x[k] += shift.x();
        out.y[k] += shift.y();
        out.z[k] += shift.z();
    }
}

}  // namespace

void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid) {
    float* const cells = grid.column(column);
    const auto count = static_cast<int>(powers.size());
    // Half of the gain, since the real and the imaginary part of a draw each have variance 1.
    const float half_gain = 0.5F * gain;
    for (int row = 0; row < count; row += drawn_together) {
        const auto power_at = [&](int at) -> Floats8 {
            return at < count ? max(Floats8::load(powers.data() + at), 0.0F) : 0.0F;
        };
        const std::array<Floats8, 2> power{power_at(row), power_at(row + lanes)};
        if (((power[0] != 0.0F).bits() | (power[1] != 0.0F).bits()) == 0U) continue;
        std::optional<std::array<Complexes8, 2>> normals;
        if (form == PowerForm::amplitude) normals = column_normals(row, column, key);
        for (int k = 0; k < 2 && row + k * lanes < count; ++k) {
            float* const to = cells + std::ptrdiff_t{2} * (row + k * lanes);
            if (!normals) {
                add_to_eight(to, power[k], 0.0F);
                continue;
            }
            const Floats8 amplitude = sqrt(half_gain * power[k]);
            add_to_eight(to, amplitude * (*normals)[k].re, amplitude * (*normals)[k].im);
        }
    }
}

void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key) {
    const auto rows = static_cast<std::size_t>((grid.rows() + lanes - 1) / lanes);
    std::vector<float> powers(rows * lanes);
    for (int c = 0; c < grid.columns(); ++c) {
        float* const cells = grid.column(c);
        for (int row = 0; row < grid.rows(); ++row)
            powers[row] = cells[std::ptrdiff_t{2} * row];
        std::fill_n(cells, std::ptrdiff_t{2} * grid.rows(), 0.0F);
        add_drawn(PowerForm::amplitude, powers, gain, c, key, grid);
    }
}

Texture::Texture(std::span<const Material> materials, double factor) {
    if (!(factor > 0.0)) return;
    for (const Material& material : materials) {
        const double per_octave = ln_per_db * factor * octave_db(material);
        strengths_.push_back({static_cast<float>(per_octave),
                              static_cast<float>(-0.5 * octaves * per_octave * per_octave)});
    }
    fine_ = make_field(fine, 0);
    coarse_ = make_field(coarse, 1);
}

void Texture::apply(std::span<const Sample> samples, const PatchBlock& pieces,
                    const SonarInScene& sonar, const TruePlaces& true_places, PhiloxKey key,
                    PatchBlock::Array<float>& power) const {
    if (!exists()) return;
    WorldPlaces places{};  // whole vectors are read
    find_places(pieces, pieces.count, sonar, places);
    if (!true_places.is_measured()) move_to_true(samples, pieces, true_places, places);
    PatchBlock::Array<float> field;
    for (int k = 0; k < pieces.count; k += lanes) {
        const Floats8 height = Floats8(share_of_height) * Floats8::load(places.z.data() + k);
        const Floats8 u = Floats8::load(places.x.data() + k) + height;
        const Floats8 v = Floats8::load(places.y.data() + k) + height;
        const Floats8 wide = field_at(coarse_, coarse, texels(u, coarse, key.k0 >> 9U),
                                      texels(v, coarse, key.k1 >> 9U));
        const Floats8 bend = Floats8(bend_m) * wide;
        const Floats8 sum = wide + field_at(fine_, fine, texels(u + bend, fine, key.k0),
                                            texels(v - bend, fine, key.k1));
        sum.store(field.data() + k);
    }
    for (int k = 0; k < pieces.count; ++k) {
        const Strength& strength = strengths_[pieces.material[k]];
        field[k] = -std::fma(strength.gain, field[k], strength.offset);
    }
    for (int k = 0; k < pieces.count; ++k)
        power[k] *= exp_neg(field[k]);
}

}  // namespace sonarsim
