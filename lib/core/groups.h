#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// The group of an item that belongs to none.
inline constexpr std::uint32_t no_group = 0xFFFFFFFFU;

/// Indices of items, group after group.
struct Groups {
    std::vector<std::uint32_t> items;
    std::vector<std::uint32_t> begin;  ///< groups + 1 offsets into `items`
};

/// Sorts items by the group that each belongs to, in linear time; within a group they stay in
/// order. `group_of` has the group of each item, 0 to groups - 1, or `no_group`: such an item is
/// left out.
Groups sort_into_groups(std::span<const std::uint32_t> group_of, std::size_t groups);

}  // namespace sonarsim
