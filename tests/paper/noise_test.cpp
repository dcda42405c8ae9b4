#include "simulate/paper/noise.h"

#include "support/draws.h"
#include "support/patches.h"
#include "support/sonars.h"
#include "support/statistics.h"

namespace {

constexpr int tests = 9;  // p-values in this file, for Sidak's correction

/// One echo of intensity 1 at 5 m in each of n cells of a row.
Echoes row_of_cells(int n) {
    Echoes echoes;
    echoes.resize(n, true);
    for (int k = 0; k < n; ++k) {
        echoes.range_m[k] = 5.0F;
        echoes.half_m[k] = 0.0F;
        echoes.weight[k] = 1.0F;
        echoes.intensity[k] = 1.0F;
        const CellName name = cell_name(k - n / 2, 3, -1);
        echoes.cell_low[k] = name.low;
        echoes.cell_high[k] = name.high;
    }
    return echoes;
}

std::vector<float> noisy(float value, int rows, int columns, float add, float mult,
                         std::uint32_t ping) {
    std::vector<float> image(static_cast<std::size_t>(rows) * columns, value);
    const PixelNoise noise{0.5F, add, mult, std::vector<float>(rows, 1.0F),
                           std::vector<float>(columns, 1.0F)};
    add_pixel_noise(image, noise, stream_key(5, 2, ping, Stream::pixel_noise));
    return image;
}

}  // namespace

TEST_CASE("the range noise of an echo does not depend on the echoes next to it") {
    // Alone an echo is the tail of a vector; among others it is part of a whole one or of a tail.
    const PhiloxKey key = stream_key(8, 1, 4, Stream::range_noise);
    for (const bool fades : {false, true}) {
        const RangeNoise noise{.lambda_m = 0.07F, .fades = fades};
        for (const int count : {1, 7, 8, 9, 127, 128, 135, 136, 137, 261}) {
            const Echoes before = row_of_cells(count);
            Echoes together = before;
            add_range_noise(together, noise, key);
            int different = 0;
            for (int k = 0; k < count; ++k) {
                Echoes alone = row_of_cells(1);
                alone.cell_low[0] = before.cell_low[k];
                alone.cell_high[0] = before.cell_high[k];
                add_range_noise(alone, noise, key);
                different += alone.range_m[0] != together.range_m[k] ? 1 : 0;
                different += alone.intensity[0] != together.intensity[k] ? 1 : 0;
            }
            CAPTURE(count);
            CHECK(different == 0);
        }
    }
}

TEST_CASE("range noise is exponential of the stated mean and fades as exp(-w / lambda)") {
    constexpr float lambda = 0.1F;
    Echoes echoes = row_of_cells(100000);
    add_range_noise(echoes, {.lambda_m = lambda, .fades = true},
                    stream_key(1, 2, 3, Stream::range_noise));
    std::vector<double> w;
    for (std::size_t k = 0; k < echoes.size(); ++k) {
        const double late = echoes.range_m[k] - 5.0;
        CHECK(late >= 0.0);
        // Ranges near 5 m are floats 5e-7 apart: w is known to 1e-6, its exponential to 1e-5.
        CHECK(echoes.intensity[k] == approx(std::exp(-late / lambda)).epsilon(2e-4));
        w.push_back(-lambda * std::log(static_cast<double>(echoes.intensity[k])));
    }
    CHECK(ks_p_value(w, [](double x) { return 1.0 - std::exp(-x / lambda); }) > sidak(tests));
    CHECK(mean(w) / lambda == approx(1.0).epsilon(0.02));
    Echoes steady = row_of_cells(1000);
    add_range_noise(steady, {.lambda_m = lambda, .fades = false},
                    stream_key(1, 2, 3, Stream::range_noise));
    CHECK(steady.intensity == row_of_cells(1000).intensity);
}

TEST_CASE("cells have names of their own") {
    constexpr std::int32_t far = 1 << 20;
    std::set<std::pair<std::uint32_t, std::uint32_t>> names;
    for (const std::int32_t x : {-far, -1, 0, 1, far - 1}) {
        for (const std::int32_t y : {-far, -1, 0, 1, far - 1}) {
            for (const std::int32_t z : {-far, -1, 0, 1, far - 1}) {
                const CellName name = cell_name(x, y, z);
                names.insert({name.low, name.high});
            }
        }
    }
    CHECK(names.size() == 125);
}

TEST_CASE("each quarter of a block of pixels follows the laws by itself") {
    // Pixels share counters of Philox: normal draws in fours, 32 apart, Rayleigh in twos, 64 apart.
    constexpr int blocks = 800;
    struct Law {
        std::vector<float> image;
        std::function<double(double)> cdf;
    };
    const Law normal{noisy(1.0F, blocks, 128, 0.0F, 0.1F, 1),
                     [](double x) { return 0.5 * std::erfc((0.5 - x) / 0.1 / std::sqrt(2.0)); }};
    const Law rayleigh{noisy(0.0F, blocks, 128, 0.2F, 0.0F, 1),
                       [](double x) { return 1.0 - std::exp(-0.5 * x * x / 0.04); }};
    for (const Law& law : {normal, rayleigh}) {
        std::array<std::vector<double>, 4> quarters;
        for (std::size_t k = 0; k < law.image.size(); ++k)
            quarters[k % 128 / 32].push_back(law.image[k]);
        for (int a = 0; a < 4; ++a) {
            CHECK(ks_p_value(quarters[a], law.cdf) > sidak(tests));
            for (int b = 0; b < a; ++b)
                CHECK(std::fabs(correlation(quarters[a], quarters[b])) <
                      4.5 / std::sqrt(blocks * 32.0));
        }
    }
}

TEST_CASE("what lights a pixel does not change what the others draw") {
    // If a block of pixels is dark, nothing is drawn for the multiplicative noise.
    std::vector<float> dark(3 * 128, 0.0F);
    std::vector<float> occupied = dark;
    occupied[130] = 1.0F;
    const PixelNoise noise{0.5F, 0.2F, 0.3F, std::vector<float>(3, 1.0F),
                           std::vector<float>(128, 1.0F)};
    add_pixel_noise(dark, noise, {7, 8});
    add_pixel_noise(occupied, noise, {7, 8});
    for (std::size_t k = 0; k < dark.size(); ++k)
        CHECK((dark[k] == occupied[k]) == (k != 130));
}

TEST_CASE("negative pixels become zero and are counted") {
    std::vector<float> image(10000, 1.0F);
    const std::uint64_t negative = add_pixel_noise(
        image, {0.5F, 0.0F, 1.0F, std::vector<float>(100, 1.0F), std::vector<float>(100, 1.0F)},
        {3, 4});
    CHECK(std::ranges::min(image) == 0.0F);
    CHECK(static_cast<std::uint64_t>(std::ranges::count(image, 0.0F)) == negative);
    // P(0.5 + N(0, 1) < 0) = Phi(-0.5) = 0.3085, standard deviation 0.0046 over 10,000.
    CHECK(static_cast<double>(negative) / 3085.0 == approx(1.0).epsilon(0.07));
}

TEST_CASE("a row becomes a streak when its share at normal incidence reaches the threshold") {
    RowAreas areas(4);
    areas.all = {1.0F, 1.0F, 1.0F, 0.0F};
    const std::vector<float> normal{0.5F, 0.25F, 0.125F, 0.0F};
    for (std::size_t i = 0; i < normal.size(); ++i)
        areas.normal.begins[i + 1].weight = normal[i];
    const std::vector<float> image{0.5F, 1.5F, 0.2F, -0.5F, 0.3F, 2.0F, 0.4F, 0.4F};
    std::vector<float> added = image;
    CHECK(add_streaks(added, areas, {StreakMode::add, 0.25F, 0.99F}) == 2);
    // 1 - (1 - I)^2 of I in [0, 1]: 0.75, 1 (1.5 clamped), 0.36, 0 (-0.5 clamped).
    const std::vector<float> expected{0.75F, 1.0F, 0.36F, 0.0F, 0.3F, 2.0F, 0.4F, 0.4F};
    for (std::size_t k = 0; k < image.size(); ++k)
        CHECK(std::fabs(added[k] - expected[k]) < 1e-6);
    std::vector<float> reduced = image;
    CHECK(add_streaks(reduced, areas, {StreakMode::reduce, 0.25F, 0.99F}) == 2);
    CHECK(reduced[0] == 0.25F);
    CHECK(reduced[1] == 1.0F);
    CHECK(reduced[5] == 2.0F);
}

// The floor at the depth h meets the range r at the cosine h / r. Its area to r grows as r^2, and
// rows whose share is near the threshold are left out.
TEST_CASE("streaks: the rows of a floor are those that lie within the angle") {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    config.streaks = {StreakMode::reduce, 0.5, 14.0};
    set_range(config, 1.0, 12.0, 100);
    const Sonar sonar = noise_free(config);
    Uniform draw(5);
    for (int trial = 0; trial < 12; ++trial) {
        const double h = draw.between(3.0, 8.0);
        const Scene scene = floor_scene(60.0F, static_cast<float>(-h), 0.5F);
        int least = 0, most = 0;
        for (int i = 0; i < 100; ++i) {
            const double near = std::max(sonar.range_edges_m[i], h);
            const double far = sonar.range_edges_m[i + 1];
            const double last = h / std::cos(radians(14.0));
            const double share = (last * last - near * near) / (far * far - near * near);
            least += far > h && share > 0.55 ? 1 : 0;
            most += far > h && share > 0.45 ? 1 : 0;
        }
        for (const EngineKind type : {EngineKind::strips, EngineKind::rays}) {
            const Ping ping = render_ping(sonar, scene, *engine_of(scene, type), Pose{}, {}, {});
            CAPTURE_ALL(h, type, ping.counts.streak_rows, least, most);
            CHECK(ping.counts.streak_rows >= static_cast<std::uint64_t>(least));
            CHECK(ping.counts.streak_rows <= static_cast<std::uint64_t>(most));
        }
    }
}

TEST_CASE("echoes: a piece reaches from its nearest to its farthest corner") {
    // Half edges along and across the line of sight, in long bins. Along, range is linear: 5 -+
    // 0.2. Across it is sqrt(25 + s^2), which reaches from 5 to 5 + 0.3^2 / 10.
    Material material;
    material.reflection = 0.25F;
    for (const float along : {0.0F, 0.2F}) {
        for (const float across : {0.0F, 0.3F}) {
            Sample sample = patch_of({5, 0, 0}, {-1, 0, 0}, {along, 0, 0}, {0, across, 0});
            sample.area_m2 = 0.5F;
            sample.height_m = along > 0.0F ? 4.0F : 5.0F;
            Echoes echoes;
            std::vector<std::uint32_t> ends;
            direct_echoes({&sample, 1}, {&material, 1}, 10.0F, {}, echoes, &ends);
            REQUIRE(echoes.size() == 1);
            CHECK(echoes.weight[0] == 0.5F);
            CHECK(echoes.intensity[0] == approx(0.25 * sample.height_m / 5.0));
            CHECK(echoes.range_m[0] - echoes.half_m[0] == approx(5.0 - along).epsilon(1e-6));
            CHECK(echoes.range_m[0] + echoes.half_m[0] ==
                  approx(5.0 + along + 0.1 * across * across).epsilon(1e-6));
        }
    }
}
