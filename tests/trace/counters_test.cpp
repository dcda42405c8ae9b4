#include "simulate/trace/counters.h"

#include <fmt/format.h>

#include "support/test.h"

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
    for (const auto& statistic : table)
        rows += fmt::format("| `{}` | {} |\n", statistic.name, statistic.text);
    return rows;
}

}  // namespace

TEST_CASE("the tables name every counter and every timer once") {
    check_complete(multipath_counters, sizeof(MultipathCounts));
    check_complete(ping_counters, sizeof(PingCounts) - sizeof(MultipathCounts));
    check_complete(ping_timers, sizeof(PingSeconds));
}

TEST_CASE("the model page says what is counted and timed") {
    const std::string page = read_file(source_folder() / "docs/model.md", 1 << 20);
    for (const std::string& rows :
         {rows_of(ping_counters), rows_of(multipath_counters), rows_of(ping_timers)}) {
        CAPTURE(rows);
        CHECK(page.find(rows) != std::string::npos);
    }
}
