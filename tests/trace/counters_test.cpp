#include "trace/counters.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/file.h"

using namespace sonarsim;

namespace {

/// Every number of a struct once: as many lines as fit into it, each with a name of its own.
template <class Struct, class Number, std::size_t n>
void check_complete(const std::array<Statistic<Struct, Number>, n>& table, std::size_t size) {
    CHECK(n * sizeof(Number) == size);
    std::set<std::string_view> names;
    Struct numbers{};
    for (const auto& statistic : table) {
        names.insert(statistic.name);
        CHECK_FALSE(statistic.text.empty());
        CHECK(numbers.*statistic.member == 0);  // no other line has its member
        numbers.*statistic.member = 1;
    }
    CHECK(names.size() == n);
}

/// The rows of a table of docs/model.md that say what the lines of `table` count.
template <class Struct, class Number, std::size_t n>
std::string rows_of(const std::array<Statistic<Struct, Number>, n>& table) {
    std::string rows;
    for (const auto& statistic : table) {
        rows += "| `";
        rows += statistic.name;
        rows += "` | ";
        rows += statistic.text;
        rows += " |\n";
    }
    return rows;
}

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("the tables name every counter and every timer once") {
    check_complete(multipath_counters, sizeof(MultipathCounts));
    check_complete(ping_counters, sizeof(PingCounts) - sizeof(MultipathCounts));
    check_complete(ping_timers, sizeof(PingSeconds));
}

TEST_CASE("counts and seconds add up") {
    PingCounts sum{.samples = 1, .multipath = {.hidden = 5}};
    sum += {.samples = 2, .streak_rows = 3, .multipath = {.rays = 4, .hidden = 6}};
    CHECK(sum.samples == 3);
    CHECK(sum.streak_rows == 3);
    CHECK(sum.multipath.rays == 4);
    CHECK(sum.multipath.hidden == 11);
    PingSeconds seconds{.trace = 0.5};
    seconds += {.trace = 0.25, .noise = 1.0};
    CHECK(seconds.trace == 0.75);
    CHECK(seconds.noise == 1.0);
}

TEST_CASE("counts as JSON and as a sentence follow the table") {
    const PingSeconds seconds{.trace = 1.0, .multipath = 2.0, .accumulate = 3.0, .noise = 4.0};
    CHECK(json_object<nlohmann::ordered_json>(ping_timers, seconds).dump() ==
          R"({"trace":1.0,"multipath":2.0,"accumulate":3.0,"noise":4.0})");
    const std::string text = sentence(multipath_counters, {.samples = 12, .clusters = 3});
    CHECK(text.starts_with("12 samples within the range, 3 clusters of them, 0 rays"));
}

TEST_CASE("the model page says what is counted and timed") {
    const std::string page = read_file(SONARSIM_SOURCE_DIR "/docs/model.md", 1 << 20);
    for (const std::string& rows :
         {rows_of(ping_counters), rows_of(multipath_counters), rows_of(ping_timers)}) {
        CAPTURE(rows);
        CHECK(page.find(rows) != std::string::npos);
    }
}

TEST_SUITE_END();
