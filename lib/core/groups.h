#pragma once

#include <cstddef>
#include <cstdint>
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
Groups sort_into_groups(std::span<const std::uint32_t> group_of, std::size_t groups);

}  // namespace sonarsim
