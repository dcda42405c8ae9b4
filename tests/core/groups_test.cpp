#include "core/groups.h"

#include <doctest/doctest.h>

using namespace sonarsim;

TEST_SUITE_BEGIN("core");

TEST_CASE("items are sorted into groups and keep their order within each") {
    using Numbers = std::vector<std::uint32_t>;
    const Groups groups = sort_into_groups(Numbers{2, 0, 2, no_group, 0, 3}, 5);
    CHECK(groups.items == Numbers{1, 4, 0, 2, 5});
    CHECK(groups.begin == Numbers{0, 2, 2, 4, 5, 5});
    const Groups nothing = sort_into_groups({}, 0);
    CHECK(nothing.items.empty());
    CHECK(nothing.begin == Numbers{0});
}

TEST_SUITE_END();
