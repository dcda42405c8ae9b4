#include "simulate/calibrated/relief.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "simulate/calibrated/bottom.h"
#include "simulate/calibrated/fourier.h"
#include "simulate/calibrated/seafloor_scattering.h"

namespace sonarsim {

namespace {

constexpr int size = Relief::size;
constexpr double max_slope = 0.2;
constexpr float max_contrast = 1.0F;

double deviation_of(const SeaBed& bed) {
    const double span = 4.0 - bed.spectral_exponent;
    const double square =
        pi * bed.spectral_strength / span * power(2.0 * pi / Relief::shortest_m, span);
    return std::min(max_slope, std::sqrt(square));
}

/// The complex numbers of a square, [size, size].
using Square = std::vector<std::complex<float>>;

/// Transforms the rows of a square, and returns the square with rows and columns swapped.
Square rows_transformed(const Square& square, bool backward) {
    const Fourier fourier(size);
    std::vector<ComplexLanes> data(size), scratch(size);
    Square out(square.size());
    for (int first = 0; first < size; first += lanes) {
        for (int k = 0; k < size; ++k) {
            for (int lane = 0; lane < lanes; ++lane) {
                const std::complex<float> value = square[(first + lane) * size + k];
                data[k].re[lane] = value.real();
                data[k].im[lane] = value.imag();
            }
        }
        if (backward)
            fourier.backward(data.data(), scratch.data());
        else
            fourier.forward(data.data(), scratch.data());
        for (int k = 0; k < size; ++k) {
            for (int lane = 0; lane < lanes; ++lane)
                out[k * size + first + lane] = {data[k].re[lane], data[k].im[lane]};
        }
    }
    return out;
}

Square transformed(const Square& square, bool backward) {
    return rows_transformed(rows_transformed(square, backward), backward);
}

/// The wave number of entry k of a transform along a side of the square, rad/m.
double wave_number(int k) {
    return 2.0 * pi / (size * Relief::texel_m) * (k < size / 2 ? k : k - size);
}

/// Heights of white noise, filtered: real and imaginary part are the slopes along x and y.
Square slopes() {
    Square square(std::size_t{size} * size);
    for (std::uint32_t k = 0; k < square.size(); ++k)
        square[k] = normal_pair(philox({k, 0, 0, 0}, {0, 0}).x0).first;
    square = transformed(square, false);
    for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
            const double kx = wave_number(i);
            const double ky = wave_number(j);
            const double length = std::sqrt(kx * kx + ky * ky);
            const bool passes = length > 0.0 && length <= 2.0 * pi / Relief::shortest_m;
            const double height = passes ? power(length, -0.5 * usual_exponent) : 0.0;
            // i kx h along x, and i times i ky h along y.
            square[i * size + j] *= std::complex<float>(static_cast<float>(-ky * height),
                                                        static_cast<float>(kx * height));
        }
    }
    return transformed(square, true);
}

int texel_along(float metres, std::uint32_t moved) {
    const auto texel =
        static_cast<std::int32_t>(std::floor(metres * static_cast<float>(1.0 / Relief::texel_m)));
    return static_cast<int>((static_cast<std::uint32_t>(texel) + moved) % size);
}

}  // namespace

std::vector<Relief::Tilt> Relief::make_tilts() {
    const Square square = slopes();
    double sum = 0.0;
    for (const std::complex<float>& slope : square)
        sum += static_cast<double>(std::norm(slope));
    const auto scale =
        static_cast<float>(static_cast<double>(Relief::per_deviation) /
                           std::sqrt(0.5 * sum / static_cast<double>(square.size())));
    const auto whole = [&](float slope) {
        return static_cast<std::int8_t>(std::lround(std::clamp(slope * scale, -127.0F, 127.0F)));
    };
    std::vector<Tilt> out;
    out.reserve(square.size());
    for (const std::complex<float>& slope : square)
        out.push_back({whole(slope.real()), whole(slope.imag())});
    return out;
}

Relief::Relief(std::span<const Material> materials, const Water& water, double factor) {
    for (const Material& material : materials) {
        const bool is_bed = is_sea_bed(material);
        deviations_.push_back(
            is_bed ? static_cast<float>(factor * deviation_of(sea_bed_of(material, water))) : 0.0F);
    }
    if (std::ranges::any_of(deviations_, [](float s) { return s > 0.0F; })) tilts_ = make_tilts();
}

void Relief::find(const WorldPlaces& places, std::span<const std::uint32_t> materials,
                  PhiloxKey key, Tilts& out) const {
    PatchBlock::Array<std::int32_t> texel;
    for (std::size_t k = 0; k < materials.size(); ++k)
        texel[k] = texel_along(places.x[k], key.k0) * size + texel_along(places.y[k], key.k1);
    for (std::size_t k = 0; k < materials.size(); ++k) {
        const Tilt tilt = tilts_[texel[k]];
        out.x[k] = tilt.x;
        out.y[k] = tilt.y;
        out.deviation[k] = deviations_[materials[k]];
    }
}

void add_relief(const PatchBlock& pieces, const Relief& relief, const SonarInScene& sonar,
                PhiloxKey key, PointEchoes& echoes) {
    if (!relief.exists()) return;
    WorldPlaces places;
    find_places(pieces, pieces.count, sonar, places);
    Relief::Tilts tilts;
    relief.find(places, {pieces.material.data(), static_cast<std::size_t>(pieces.count)}, key,
                tilts);
    const Eigen::Vector2f from = sonar.sensor.head<2>().cast<float>();
    for (int k = 0; k < pieces.count; ++k) {
        const float dx = places.x[k] - from.x();
        const float dy = places.y[k] - from.y();
        const float range = echoes.range_m[k];
        const float height = std::max(pieces.height_m[k], 1e-3F * range);
        const float along = std::sqrt(std::max(0.0F, range * range - height * height));
        const float contrast = std::min(max_contrast, 2.0F * tilts.deviation[k] * along / height);
        const float towards = (tilts.x[k] * dx + tilts.y[k] * dy) /
                              (Relief::per_deviation * std::sqrt(dx * dx + dy * dy + 1e-12F));
        echoes.power[k] *= exp_neg(contrast * (0.5F * contrast - towards));
    }
}

}  // namespace sonarsim
