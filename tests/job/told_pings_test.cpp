#include "job/told_pings.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/sha256.h"

using namespace sonarsim;

namespace {

using Words = std::vector<std::string>;

std::string entry_of(std::uint32_t k) {
    return entry_text({1000 + k, sha256(std::to_string(k))});
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("told pings: every word comes back as it was") {
        ToldPings told;
        // In no order, and with words that are no entry of a file or not written as we write them.
        told.add({7, 1}, {entry_of(1), "0123abcd", entry_of(2)});
        told.add({7, 0}, {});
        told.add({3, 1}, {"", "12:", ":" + sha256("x"), "007:" + sha256("x"),
                          "7:" + std::string(64, 'A'), "7:" + std::string(63, 'a')});
        told.add({7, 1}, {entry_of(9)});
        told.sort();
        CHECK(told.size() == 3);
        CHECK(told.find({7, 1}) == Words{entry_of(9)});
        CHECK(told.find({7, 0}) == Words{});
        CHECK(told.find({3, 1}) == Words{"", "12:", ":" + sha256("x"), "007:" + sha256("x"),
                                         "7:" + std::string(64, 'A'), "7:" + std::string(63, 'a')});
        CHECK(!told.find({3, 0}));
        CHECK(!told.find({8, 0}));
        std::vector<PingId> order;
        told.for_each([&](const PingId& ping, const Words&) { order.push_back(ping); });
        CHECK(order == std::vector<PingId>{{3, 1}, {7, 0}, {7, 1}});
    }

    TEST_CASE("told pings: a ping of three files takes no more than 150 bytes") {
        constexpr std::uint32_t pings = 10'000;
        ToldPings told;
        for (std::uint32_t k = 0; k < pings; ++k)
            told.add({k, 0}, {entry_of(3 * k), entry_of(3 * k + 1), entry_of(3 * k + 2)});
        told.sort();
        // 3 x (1 + 8 + 32) bytes, the number of words in 4, and 16 to find them: 143.
        CHECK(told.bytes() <= 150 * pings);
        CHECK(told.find({pings - 1, 0}) ==
              Words{entry_of(3 * pings - 3), entry_of(3 * pings - 2), entry_of(3 * pings - 1)});
    }
}
