#include "job/turns.h"

#include <doctest/doctest.h>

using namespace sonarsim;

TEST_SUITE_BEGIN("job");

TEST_CASE("job: turns hold each item once, and the last items have turns of their own") {
    for (const std::size_t each : {1, 2, 3}) {
        for (const std::size_t threads : {1, 2, 8}) {
            for (std::size_t items = 0; items < 60; ++items) {
                const Turns turns(items, each, threads);
                REQUIRE(turns.begin(0) == 0);
                REQUIRE(turns.begin(turns.count()) == items);
                for (std::size_t turn = 0; turn < turns.count(); ++turn) {
                    const std::size_t size = turns.begin(turn + 1) - turns.begin(turn);
                    const bool is_late = items - turns.begin(turn) < each + 4 * threads;
                    REQUIRE(size == (is_late ? 1 : each));
                }
            }
        }
    }
}

TEST_SUITE_END();
