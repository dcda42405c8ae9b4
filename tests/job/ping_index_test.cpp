#include "job/ping_index.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/sha256.h"

using namespace sonarsim;

namespace {

using Fields = std::vector<std::string>;

std::string entry_of(std::uint32_t k) {
    return entry_text({1000 + k, sha256(std::to_string(k))});
}

}  // namespace

TEST_SUITE("job") {
    TEST_CASE("ping index: every field comes back as it was") {
        PingIndex index;
        // In no order, and with fields that are no entries of files, or are written in another way.
        index.add({7, 1}, {entry_of(1), "0123abcd", entry_of(2)});
        index.add({7, 0}, {});
        index.add({3, 1}, {"", "12:", ":" + sha256("x"), "007:" + sha256("x"),
                           "7:" + std::string(64, 'A'), "7:" + std::string(63, 'a')});
        index.add({7, 1}, {entry_of(9)});
        index.sort();
        CHECK(index.size() == 3);
        CHECK(index.find({7, 1}) == Fields{entry_of(9)});
        CHECK(index.find({7, 0}) == Fields{});
        CHECK(index.find({3, 1}) == Fields{"", "12:", ":" + sha256("x"), "007:" + sha256("x"),
                                           "7:" + std::string(64, 'A'),
                                           "7:" + std::string(63, 'a')});
        CHECK(!index.find({3, 0}));
        CHECK(!index.find({8, 0}));
        std::vector<PingId> order;
        index.for_each([&](const PingId& ping, const Fields&) { order.push_back(ping); });
        CHECK(order == std::vector<PingId>{{3, 1}, {7, 0}, {7, 1}});
    }

    TEST_CASE("ping index: a ping of three files takes no more than 150 bytes") {
        constexpr std::uint32_t pings = 10'000;
        PingIndex index;
        for (std::uint32_t k = 0; k < pings; ++k)
            index.add({k, 0}, {entry_of(3 * k), entry_of(3 * k + 1), entry_of(3 * k + 2)});
        index.sort();
        // 3 x (1 + 8 + 32) bytes, the number of fields in 4, and 16 to find them: 143.
        CHECK(index.bytes() <= 150 * pings);
        CHECK(index.find({pings - 1, 0}) ==
              Fields{entry_of(3 * pings - 3), entry_of(3 * pings - 2), entry_of(3 * pings - 1)});
    }
}
