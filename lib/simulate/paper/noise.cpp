#include "simulate/paper/noise.h"

#include <array>
#include <iterator>

#include "core/elementary.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr std::size_t pixels_per_block = 128;
constexpr std::size_t half_block = pixels_per_block / 2;

using Lane = std::array<float, pixels_per_block>;

// The second word of a Philox counter is the purpose of the draw, the first its number.
constexpr std::uint32_t additive = 0;
constexpr std::uint32_t multiplicative = 1;

/// `count` pairs of random words from counter number `first` on.
template <std::size_t count>
void draw_words(std::uint32_t first, std::uint32_t purpose, PhiloxKey key,
                std::array<std::uint32_t, count>& a, std::array<std::uint32_t, count>& b) {
    for (std::size_t k = 0; k < count; ++k)
        a[k] = first + static_cast<std::uint32_t>(k);
    b.fill(purpose);
    philox_pairs(a.data(), b.data(), count, key);
}

/// Rayleigh(1) for each pixel of a block, by inversion: sqrt(-2 ln u). A counter serves two pixels.
void draw_rayleigh(std::uint32_t block, PhiloxKey key, Lane& out) {
    std::array<std::uint32_t, half_block> a, b;
    draw_words(block * half_block, additive, key, a, b);
    for (std::size_t k = 0; k < half_block; ++k) {
        out[k] = std::sqrt(-2.0F * natural_log(unit_float(a[k])));
        out[half_block + k] = std::sqrt(-2.0F * natural_log(unit_float(b[k])));
    }
}

template <std::size_t count>
void draw_pairs(const std::array<std::uint32_t, count>& words, float* __restrict first,
                float* __restrict second) {
    for (std::size_t k = 0; k < count; ++k) {
        const NormalPair pair = normal_pair(words[k]);
        first[k] = pair.first;
        second[k] = pair.second;
    }
}

/// A draw of normal(0, 1) for each pixel of a block. One counter serves four pixels.
void draw_normal(std::uint32_t block, PhiloxKey key, Lane& out) {
    constexpr std::size_t quarter = pixels_per_block / 4;
    std::array<std::uint32_t, quarter> a, b;
    draw_words(block * quarter, multiplicative, key, a, b);
    draw_pairs(a, out.data(), out.data() + quarter);
    draw_pairs(b, out.data() + 2 * quarter, out.data() + 3 * quarter);
}

bool any_signal(std::span<const float> pixels) {
    // No early return: the whole block in vectors is faster.
    int occupied = 0;
    for (const float pixel : pixels)
        occupied |= pixel != 0.0F ? 1 : 0;
    return occupied != 0;
}

/// s sigma_a of the pixels from number `first` on.
void add_scales(const PixelNoise& noise, std::size_t first, std::size_t count, Lane& out) {
    const std::size_t columns = noise.lobe_scale.size();
    std::size_t row = first / columns;
    std::size_t column = first % columns;
    for (std::size_t k = 0; k < count; ++row, column = 0) {
        const std::size_t end = std::min(k + columns - column, count);
        for (; k < end; ++k, ++column)
            out[k] = noise.range_scale[row] * noise.lobe_scale[column] * noise.add_sigma;
    }
}

int apply(std::span<float> pixels, const PixelNoise& noise, const Lane& scale, const Lane& normal,
          const Lane& rayleigh) {
    int negative = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const float gain = std::fma(noise.mult_sigma, normal[k], noise.gain);
        const float value = std::fma(pixels[k], gain, scale[k] * rayleigh[k]);
        negative += value < 0.0F ? 1 : 0;
        pixels[k] = value < 0.0F ? 0.0F : value;
    }
    return negative;
}

constexpr std::size_t block = 128;
constexpr std::size_t lanes_of_philox = 8;

}  // namespace

std::uint64_t add_pixel_noise(std::span<float> image, const PixelNoise& noise, PhiloxKey key) {
    std::uint64_t negative = 0;
    Lane scale{};
    Lane normal{};
    Lane rayleigh{};
    for (std::size_t begin = 0; begin < image.size(); begin += pixels_per_block) {
        const auto number = static_cast<std::uint32_t>(begin / pixels_per_block);
        const auto pixels = image.subspan(begin, std::min(pixels_per_block, image.size() - begin));
        add_scales(noise, begin, pixels.size(), scale);
        draw_rayleigh(number, key, rayleigh);
        // The normal draws multiply the signal; a block without signal does not need new ones.
        if (any_signal(pixels)) draw_normal(number, key, normal);
        negative += apply(pixels, noise, scale, normal, rayleigh);
    }
    return negative;
}

RowAreas::RowAreas(int rows) : all(rows, 0.0F) {
    normal.clear(rows);
}

void RowAreas::add(const BinSums& beam) {
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] += beam.weight(i);
}

std::vector<Sample> near_normal_incidence(std::span<const Sample> samples, float min_cosine) {
    std::vector<Sample> out;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(out), [&](const Sample& s) {
        const float extent = s.edge_u.norm() + 2.0F * s.edge_v.norm();
        return s.height_m > min_cosine * (arrival_range(s.position) - extent);
    });
    return out;
}

void cut_to_normal_incidence(std::span<const Sample> samples, std::span<const std::uint32_t> ends,
                             float min_cosine, RangeBoxes& echoes) {
    std::size_t i = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const float last_m = samples[k].height_m / min_cosine;
        for (; i < ends[k]; ++i) {
            const float near_m = echoes.range_m[i] - echoes.half_m[i];
            const float far_m = std::min(echoes.range_m[i] + echoes.half_m[i], last_m);
            if (near_m + 2.0F * echoes.half_m[i] <= last_m) continue;
            const float half_m = std::max(0.5F * (far_m - near_m), 0.0F);
            echoes.weight[i] *= half_m / echoes.half_m[i];
            echoes.range_m[i] = near_m + half_m;
            echoes.half_m[i] = half_m;
        }
    }
}

std::uint64_t add_streaks(std::span<float> image, const RowAreas& areas, const Streaks& streaks) {
    const std::size_t columns = image.size() / areas.all.size();
    std::uint64_t rows = 0;
    for (std::size_t i = 0; i < areas.all.size(); ++i) {
        const float needed = streaks.threshold * areas.all[i];
        if (!(areas.all[i] > 0.0F && areas.normal.weight(i) >= needed)) continue;
        ++rows;
        for (float& pixel : image.subspan(i * columns, columns)) {
            const float x = std::clamp(pixel, 0.0F, 1.0F);
            pixel = streaks.mode == StreakMode::add ? 1.0F - (1.0F - x) * (1.0F - x) : x * x;
        }
    }
    return rows;
}

ScattererLattice scatterer_lattice(const RangeNoise& noise, const Scene& scene,
                                   const Pose& T_world_sensor) {
    if (noise.lambda_m <= 0.0F) return {};
    return {.edge_m = noise.scatterer_m,
            .R_world_sensor = T_world_sensor.rotation.toRotationMatrix().cast<float>(),
            .sensor = (T_world_sensor.translation - scene.origin).cast<float>()};
}

void add_range_noise(Echoes& echoes, const RangeNoise& noise, PhiloxKey key) {
    if (noise.lambda_m <= 0.0F) return;
    const float keep = noise.fades ? 0.0F : 1.0F;
    const std::size_t whole = echoes.size() / lanes_of_philox * lanes_of_philox;
    for (std::size_t begin = 0; begin < echoes.size();) {
        // In place while whole vectors are left: the names of cells are not needed after this.
        const std::size_t count =
            begin < whole ? std::min(block, whole - begin) : echoes.size() - begin;
        std::array<std::uint32_t, lanes_of_philox> last_low{}, last_high{};
        std::uint32_t* low = echoes.cell_low.data() + begin;
        std::uint32_t* high = echoes.cell_high.data() + begin;
        if (begin == whole) {
            std::copy_n(low, count, last_low.begin());
            std::copy_n(high, count, last_high.begin());
            low = last_low.data();
            high = last_high.data();
        }
        philox_pairs(low, high, std::max(count, lanes_of_philox), key);
        float* const __restrict range = echoes.range_m.data() + begin;
        float* const __restrict intensity = echoes.intensity.data() + begin;
        for (std::size_t k = 0; k < count; ++k) {
            // w = -lambda ln u, so that exp(-w / lambda) is u itself.
            const float u = unit_float(low[k]);
            range[k] -= noise.lambda_m * natural_log(u);
            intensity[k] *= keep + (1.0F - keep) * u;
        }
        begin += count;
    }
}

}  // namespace sonarsim
