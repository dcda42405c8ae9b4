#include "core/ordered_pipeline.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sonarsim;

namespace {

constexpr std::size_t threads = 4;
constexpr std::size_t in_flight = 6;

// Four worker threads, even on a machine with one core.
struct FourThreads {
    tbb::global_control limit{tbb::global_control::max_allowed_parallelism, threads};
};

/// Work whose duration decreases with i, so that results complete out of order.
std::string work_on(std::size_t i) {
    std::atomic<unsigned> spin = 0;
    for (std::size_t k = 0; k < 2000 * (7 - i % 7); ++k)
        ++spin;
    return std::to_string(i);
}

}  // namespace

TEST_SUITE_BEGIN("core");

TEST_CASE("an ordered pipeline hands over every result once, in order, and few at a time") {
    const FourThreads four;
    constexpr std::size_t count = 1000;
    std::atomic<std::size_t> alive = 0;
    std::atomic<std::size_t> most = 0;
    std::vector<std::string> results;
    ordered_pipeline(
        count, in_flight, false,
        [&](std::size_t i) {
            const std::size_t now = ++alive;
            std::size_t seen = most;
            while (seen < now && !most.compare_exchange_weak(seen, now)) {
            }
            return work_on(i);
        },
        [&](const std::string& result) {
            results.push_back(result);
            --alive;
        });
    REQUIRE(results.size() == count);
    for (std::size_t i = 0; i < count; ++i)
        REQUIRE(results[i] == std::to_string(i));
    CHECK(most <= in_flight);
}

TEST_CASE("a stopped pipeline finishes what it has begun") {
    const FourThreads four;
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> begun = 0;
    std::vector<std::string> results;
    ordered_pipeline(
        1000, in_flight, stop,
        [&](std::size_t i) {
            ++begun;
            return work_on(i);
        },
        [&](const std::string& result) {
            results.push_back(result);
            if (results.size() == 20) stop = true;
        });
    CHECK(results.size() == begun);
    CHECK(results.size() >= 20);
    CHECK(results.size() <= 20 + in_flight);
    CHECK(results.back() == std::to_string(results.size() - 1));
}

TEST_CASE("what work throws ends the pipeline") {
    const FourThreads four;
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

TEST_SUITE_END();
