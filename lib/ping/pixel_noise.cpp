#include "ping/pixel_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t pairs_per_block = 128;

using Lane = std::array<float, pairs_per_block>;

/// Unit draws for as many pairs of pixels as a block holds.
struct Draws {
    std::array<Lane, 2> normal;
    std::array<Lane, 2> rayleigh;
};

/// One Philox block serves two pixels: two Rayleigh draws by inversion, sqrt(-2 ln u), and two
/// normal ones by Box and Muller.
void draw(std::uint32_t row, std::uint32_t first_pair, PhiloxKey key, Draws& draws) {
    std::array<std::uint32_t, pairs_per_block> x0, x1, x2{}, x3{};
    std::iota(x0.begin(), x0.end(), first_pair);
    x1.fill(row);
    philox_batch(x0.data(), x1.data(), x2.data(), x3.data(), pairs_per_block, key);
    for (std::size_t k = 0; k < pairs_per_block; ++k) {
        draws.rayleigh[0][k] = std::sqrt(-2.0F * natural_log(unit_float(x0[k])));
        draws.rayleigh[1][k] = std::sqrt(-2.0F * natural_log(unit_float(x1[k])));
        const float radius = std::sqrt(-2.0F * natural_log(unit_float(x2[k])));
        const SinCosFloat angle =
            sincos_small(static_cast<float>(2.0 * pi) * (unit_float(x3[k]) - 0.5F));
        draws.normal[0][k] = radius * angle.cos;
        draws.normal[1][k] = radius * angle.sin;
    }
}

int apply(std::span<float> pixels, const PixelNoise& noise, float range_scale, const float* lobe,
          const Lane& normal, const Lane& rayleigh) {
    int negative = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const float gain = std::fma(noise.mult_sigma, normal[k], noise.gain);
        const float value =
            std::fma(pixels[k], gain, range_scale * lobe[k] * noise.add_sigma * rayleigh[k]);
        negative += value < 0.0F ? 1 : 0;
        pixels[k] = value < 0.0F ? 0.0F : value;
    }
    return negative;
}

}  // namespace

std::uint64_t add_pixel_noise(std::span<float> image, const PixelNoise& noise, PhiloxKey key) {
    const std::size_t columns = noise.lobe_scale.size();
    std::uint64_t negative = 0;
    Draws draws;
    for (std::size_t row = 0; row < noise.range_scale.size(); ++row) {
        const std::span<float> line = image.subspan(row * columns, columns);
        for (std::size_t begin = 0; begin < columns; begin += 2 * pairs_per_block) {
            draw(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(begin / 2), key,
                 draws);
            for (std::size_t lane = 0; lane < 2; ++lane) {
                const std::size_t from = std::min(begin + lane * pairs_per_block, columns);
                const std::size_t to = std::min(from + pairs_per_block, columns);
                negative +=
                    apply(line.subspan(from, to - from), noise, noise.range_scale[row],
                          noise.lobe_scale.data() + from, draws.normal[lane], draws.rayleigh[lane]);
            }
        }
    }
    return negative;
}

}  // namespace sonarsim
