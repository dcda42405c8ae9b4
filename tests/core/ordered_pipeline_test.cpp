#include "core/ordered_pipeline.h"

#include <tbb/global_control.h>

#include "support/test.h"

namespace {

constexpr std::size_t in_flight = 6;

/// Work whose duration decreases with i, so that results complete out of order.
std::string work_on(std::size_t i) {
    std::atomic<unsigned> spin = 0;
    for (std::size_t k = 0; k < 2000 * (7 - i % 7); ++k)
        ++spin;
    return std::to_string(i);
}

}  // namespace

TEST_CASE("an ordered pipeline hands over each result once, in order, few at a time") {
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    constexpr std::size_t count = 1000;
    for (const std::size_t stop_after : {count, std::size_t{20}}) {
        std::atomic<bool> stop = false;
        std::atomic<std::size_t> begun = 0;
        std::atomic<std::size_t> alive = 0;
        std::atomic<std::size_t> max_running = 0;
        std::vector<std::string> results;
        ordered_pipeline(
            count, in_flight, stop,
            [&](std::size_t i) {
                ++begun;
                const std::size_t now = ++alive;
                std::size_t visible = max_running;
                while (visible < now && !max_running.compare_exchange_weak(visible, now)) {
                }
                return work_on(i);
            },
            [&](const std::string& result) {
                results.push_back(result);
                --alive;
                if (results.size() == stop_after) stop = true;
            });
        // It finishes what it has begun.
        CHECK(results.size() == begun);
        CHECK(results.size() >= stop_after);
        CHECK(results.size() <= stop_after + in_flight);
        for (std::size_t i = 0; i < results.size(); ++i)
            REQUIRE(results[i] == std::to_string(i));
        CHECK(max_running <= in_flight);
    }
}

TEST_CASE("what work throws ends the pipeline") {
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    const auto work = [](std::size_t i) {
        if (i == 30) throw std::runtime_error("thirty");
        return work_on(i);
    };
    std::size_t finished = 0;
    CHECK_THROWS_WITH(
        ordered_pipeline(1000, in_flight, false, work, [&](const std::string&) { ++finished; }),
        "thirty");
    CHECK(finished <= 30);
}
