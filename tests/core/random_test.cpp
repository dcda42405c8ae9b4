#include "core/random.h"

#include <Random123/philox.h>

#include "support/test.h"

TEST_CASE("philox is the function of Random123") {
    r123::Philox4x32 reference;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const PhiloxBlock c{i, i * 2654435761U, ~i, i << 7};
        const PhiloxKey key{i * 40503U, 0x12345678U ^ i};
        const auto want = reference({{c.x0, c.x1, c.x2, c.x3}}, {{key.k0, key.k1}});
        const PhiloxBlock got = philox(c, key);
        CHECK((want == r123::Philox4x32::ctr_type{{got.x0, got.x1, got.x2, got.x3}}));
    }
}

TEST_CASE("pairs are those of Random123, the second key in the counter") {
    constexpr std::size_t n = 64;
    r123::Philox2x32_R<pair_rounds> reference;
    std::array<std::uint32_t, n> x0, x1;
    for (std::uint32_t k = 0; k < n; ++k) {
        x0[k] = 2654435761U * k;
        x1[k] = ~k << (k % 30);
    }
    const auto a = x0, b = x1;
    const PhiloxKey key{0xdeadbeefU, 0xcafef00dU};
    philox_pairs(x0.data(), x1.data(), n, key);
    for (std::size_t k = 0; k < n; ++k) {
        const auto want = reference({{a[k], b[k] ^ key.k1}}, {{key.k0}});
        CHECK(x0[k] == want[0]);
        CHECK(x1[k] == want[1]);
    }
}

TEST_CASE("unit floats stay inside (0, 1); every seed, sensor, ping and stream has its own key") {
    CHECK(unit_float(0) > 0.0F);
    CHECK(unit_float(0xFFFFFFFFU) < 1.0F);
    std::set<std::pair<std::uint32_t, std::uint32_t>> keys;
    std::size_t count = 0;
    for (std::uint64_t seed : {0ULL, 1ULL, 1ULL << 32}) {
        for (std::uint32_t sensor : {0U, 1U, 77U}) {
            for (std::uint32_t ping = 0; ping < 1000; ++ping) {
                for (const Stream s : {Stream::range_noise, Stream::pixel_noise}) {
                    const PhiloxKey key = stream_key(seed, sensor, ping, s);
                    keys.insert({key.k0, key.k1});
                    ++count;
                }
            }
        }
    }
    CHECK(keys.size() == count);
}
