#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "paper/accumulate.h"
#include "sonar/setup.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "visibility/view.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

TEST_CASE("a million pings of two sensors: no two of their random streams are the same" *
          doctest::skip(test::sanitized)) {
    // 6 million keys of 64 bits: the probability that two of them are equal is n^2 / 2^65 = 1e-6,
    // and the keys do not vary from run to run.
    std::vector<std::uint64_t> keys;
    keys.reserve(6'000'000);
    for (const char* const sensor : {"fls", "sss"}) {
        const std::uint32_t name = number_of_name(sensor);
        for (std::uint32_t ping = 0; ping < 1'000'000; ++ping) {
            for (const Stream stream :
                 {Stream::range_noise, Stream::pixel_noise, Stream::multipath_range_noise}) {
                const PhiloxKey key = stream_key(7, name, ping, stream);
                keys.push_back(std::uint64_t{key.k1} << 32 | key.k0);
            }
        }
    }
    std::sort(keys.begin(), keys.end());
    CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

TEST_CASE("float sums against double sums: a bin of a million echoes") {
    // n additions of positive numbers in float have an error of at most n 2^-24 of the sum: for 1e6
    // echoes 6 %. Roundings have both signs, so the actual error is nearer to sqrt(n) 2^-24; and
    // the mean is a quotient of two sums with similar errors. A ping's fullest bin has some 1e4
    // echoes.
    for (const std::size_t n : {std::size_t{10'000}, std::size_t{1'000'000}}) {
        Echoes echoes;
        echoes.resize(n, false);
        double weight = 0.0;
        double echo = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const PhiloxBlock random = philox({static_cast<std::uint32_t>(k), 0, 0, 0}, {1, 2});
            echoes.range_m[k] = 5.0F;
            echoes.half_m[k] = 0.01F;
            echoes.weight[k] = 1e-4F * unit_float(random.x0);
            echoes.intensity[k] = unit_float(random.x1);
            weight += static_cast<double>(echoes.weight[k]);
            echo += static_cast<double>(echoes.weight[k]) * echoes.intensity[k];
        }
        BinSums sums;
        sums.clear(1);
        CHECK(accumulate(echoes, {0.0F, 10.0F, 1}, sums) == 0);
        std::vector<float> mean(1);
        mean_of_bins(sums, mean);
        const double bound = static_cast<double>(n) * 0x1p-24;
        CHECK(std::fabs(sums.weight(0) - weight) < bound * weight);
        CHECK(std::fabs(sums.echo(0) - echo) < bound * echo);
        const double off = std::fabs(mean[0] * weight / echo - 1.0);
        MESSAGE(n << " echoes in one bin: the mean is off by " << off);
        CHECK(off < (n > 100'000 ? 1e-3 : 2e-5));
    }
}

TEST_CASE("an echo that is not a number is dropped and counted") {
    Echoes echoes;
    echoes.resize(4, false);
    const float nan = std::nanf("");
    echoes.range_m = {nan, INFINITY, -1.0F, 0.5F};
    echoes.half_m = {0.1F, INFINITY, 0.1F, nan};
    echoes.weight = {1, 1, 1, 1};
    echoes.intensity = {1, 1, 1, 1};
    BinSums sums;
    sums.clear(4);
    CHECK(accumulate(echoes, {0.0F, 0.5F, 4}, sums) == 4);
    for (int i = 0; i < 4; ++i)
        CHECK(sums.weight(i) == 0.0F);
}

TEST_CASE("an echo just short of the first bin or beyond the last is dropped, one across is cut") {
    // Bins from 2 to 3 m, 0.25 m each. Truncation towards zero would put 1.8 m into the first bin.
    Echoes echoes;
    echoes.resize(5, false);
    echoes.range_m = {1.8F, 3.2F, 3.01F, 2.0F, 2.99F};
    echoes.half_m = {0.1F, 0.1F, 0.0F, 0.1F, 0.1F};
    echoes.weight = {1, 1, 1, 1, 1};
    echoes.intensity = {1, 1, 1, 1, 1};
    BinSums sums;
    sums.clear(4);
    CHECK(accumulate(echoes, {2.0F, 0.25F, 4}, sums) == 3);
    CHECK(sums.weight(0) == test::approx(0.5));  // the half of 1.9 to 2.1 m that is in range
    CHECK(sums.weight(1) == 0.0F);
    CHECK(sums.weight(2) == 0.0F);
    CHECK(sums.weight(3) == test::approx(0.55));  // the part of 2.89 to 3.09 m below 3
}

TEST_CASE("fields of view are half-open: the last edge belongs to no beam") {
    View view{radians(90.0), radians(90.0), 0.0, 10.0, 10, 3, 0.03, ViewShape::fan};
    const BeamLocator field(view);
    const auto both = [&](const Eigen::Vector3f& p) {
        const float beam = field.beam(p, p.norm());
        const int fast = beam < 0.0F ? -1 : static_cast<int>(beam);
        CHECK(fast == beam_of(view, p));
        return fast;
    };
    // 2e-5 rad to either side of the edges at 45 degrees.
    CHECK(both({1.0F, -0.99998F, 0.0F}) == 0);
    CHECK(both({1.0F, -1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.99998F, 0.0F}) == 2);
    CHECK(both({1.0F, 1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.0F, 0.99998F}) == 1);
    CHECK(both({1.0F, 0.0F, 1.00002F}) == -1);
    CHECK(both({-1.0F, 0.0F, 0.0F}) == -1);
    view.azimuth_rad = 2.0 * pi;
    // Straight behind is exactly the seam of a full turn: in the first beam or in none.
    CHECK(beam_of(view, {-1.0F, -1e-3F, 0.0F}) == 0);
    CHECK(beam_of(view, {-1.0F, 1e-3F, 0.0F}) == 2);
}

TEST_SUITE_END();
