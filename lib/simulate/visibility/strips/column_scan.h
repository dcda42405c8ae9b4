#pragma once

#include <cstdint>
#include <vector>

#include "simulate/visibility/strips/strip_samples.h"

namespace sonarsim {

/// Finds the visible strips of a frame's columns.
class ColumnScan {
  public:
    /// All arguments must outlive it.
    ColumnScan(const ClustersInView& clusters, const std::vector<StripTriangle>& triangles,
               const ColumnFrame& frame, const StripRule& rule, std::vector<Sample>& out);

    /// Adds the samples of a column between two u, from its triangles. Columns are scanned once
    /// each.
    void scan(std::span<const std::uint32_t> column_triangles, float left, float right);

  private:
    void add_piece(int i);
    void add_small(int i, const StripTriangle& t);
    void add_at_border(int i, float from, float to);
    void add_between(int i, float from, float to);
    VisibleInterval whole_at(int i, float u) const;

    const std::vector<StripTriangle>& triangles_;
    const ColumnFrame& frame_;
    const StripRule& rule_;
    ColumnPieces pieces_;
    PieceVisibility visibility_;
    StripSamples samples_;
    int column_ = 0;                    ///< number of columns so far
    std::vector<std::uint32_t> hider_;  ///< for each triangle, the one that hid its last piece
    std::vector<int> piece_of_;         ///< for each triangle, in its last column
    std::vector<int> column_of_;
};

}  // namespace sonarsim
