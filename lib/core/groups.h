#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace sonarsim {

/// Marks an item that belongs to no group.
inline constexpr std::uint32_t no_group = 0xFFFFFFFFU;

/// Indices of items, group after group.
struct Groups {
    std::vector<std::uint32_t> items;
    std::vector<std::uint32_t> begin;  ///< groups + 1 offsets into `items`
};

/// Sorts items by group in linear time and keeps their order within a group. `group_of` holds the
/// group of each item, 0 to groups - 1; items with `no_group` are left out.
inline Groups sort_into_groups(std::span<const std::uint32_t> group_of, std::size_t groups) {
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
