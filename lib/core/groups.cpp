#include "core/groups.h"

#include <numeric>

namespace sonarsim {

Groups sort_into_groups(std::span<const std::uint32_t> group_of, std::size_t groups) {
    Groups sorted;
    sorted.begin.assign(groups + 1, 0);
    for (const std::uint32_t group : group_of)
        if (group != no_group) ++sorted.begin[group + 1];
    std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
    sorted.items.resize(sorted.begin.back());
    std::vector<std::uint32_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
    for (std::uint32_t i = 0; i < group_of.size(); ++i)
        if (group_of[i] != no_group) sorted.items[next[group_of[i]]++] = i;
    return sorted;
}

}  // namespace sonarsim
