#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "calibrated/cell_footprints.h"
#include "calibrated/cell_lanes.h"

namespace sonarsim {

/// Larger cells of the samples of a batch: their numbers from the base of their sample's footprint,
/// along its two axes.
struct CellList {
    std::vector<std::int32_t> column, row;
    std::vector<std::int32_t> bits;  ///< random, by the cell
    int count = 0;
    std::array<int, CellFootprints::most + 1> begin{};  ///< by sample

    CellList() { grow(); }
    void grow() {
        const std::size_t size = std::max<std::size_t>(2 * bits.size(), 1024);
        column.resize(size);
        row.resize(size);
        bits.resize(size);
    }
    void add(const ToFront& front, __m256i columns, __m256i rows, __m256i random) {
        // Whole vectors are written, and read from any cell on.
        if (count + 2 * search_lanes > std::ssize(bits)) grow();
        store_numbers(column.data() + count, front(columns));
        store_numbers(row.data() + count, front(rows));
        store_numbers(bits.data() + count, front(random));
        count += front.count;
    }
};

/// Lists the larger cells that a batch of samples may lie on: those that hold a scatterer as a
/// whole, and those that are split and hold four.
void list_cells(const CellFootprints& footprints, std::uint32_t key, CellList& whole,
                CellList& split);

}  // namespace sonarsim
