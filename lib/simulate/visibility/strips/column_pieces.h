#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/lanes.h"
#include "simulate/visibility/strips/strip_triangles.h"

namespace sonarsim {

/// Eight pieces of a column. A piece is the part of a triangle in the column: `from` <= u < `to`,
/// above the greater of two lines and below the lesser of two others. Lines and plane are given at
/// `middle`, the plane also at `w`.
struct alignas(32) PieceBlock {
    using Row = std::array<float, lanes>;
    Row from, to, middle;
    Row low_a, low_a_slope, low_b, low_b_slope;
    Row high_a, high_a_slope, high_b, high_b_slope;
    Row q, q_u, q_w, w;
    Row q_min, q_max, w_min, w_max;
    std::array<std::int32_t, lanes> number;
    std::array<std::uint32_t, lanes> triangle;  ///< index into StripTriangles::items
};

/// The bounds of eight blocks.
struct alignas(32) PieceBounds {
    PieceBlock::Row from, to, w_min, w_max, q_max;
};

/// One end of a piece on a line u = const, and its slope.
struct PieceEnd {
    float w, slope;
};

/// The pieces of one column, front to back by clusters. Memory is reused from column to column.
class ColumnPieces {
  public:
    /// `to_border_w`: the greatest |w| of the view in the column.
    void gather(const std::vector<StripTriangle>& triangles,
                std::span<const std::uint32_t> column_triangles, float left, float right,
                float to_border_w);

    int count() const { return count_; }
    const std::vector<PieceBlock>& blocks() const { return blocks_; }
    const std::vector<PieceBounds>& bounds() const { return bounds_; }
    const PieceBlock& block_of(int i) const { return blocks_[i / lanes]; }

    std::uint32_t triangle(int i) const { return block_of(i).triangle[i % lanes]; }

    PieceEnd low(int i, float u) const {
        const PieceBlock& p = block_of(i);
        const int k = i % lanes;
        const float d = u - p.middle[k];
        const float a = p.low_a[k] + p.low_a_slope[k] * d;
        const float b = p.low_b[k] + p.low_b_slope[k] * d;
        return a > b ? PieceEnd{a, p.low_a_slope[k]} : PieceEnd{b, p.low_b_slope[k]};
    }
    PieceEnd high(int i, float u) const {
        const PieceBlock& p = block_of(i);
        const int k = i % lanes;
        const float d = u - p.middle[k];
        const float a = p.high_a[k] + p.high_a_slope[k] * d;
        const float b = p.high_b[k] + p.high_b_slope[k] * d;
        return a < b ? PieceEnd{a, p.high_a_slope[k]} : PieceEnd{b, p.high_b_slope[k]};
    }
    /// 1 / X of its plane.
    float q_at(int i, float u, float w) const {
        const PieceBlock& p = block_of(i);
        const int k = i % lanes;
        return p.q[k] + p.q_u[k] * (u - p.middle[k]) + p.q_w[k] * (w - p.w[k]);
    }

  private:
    bool add(const StripTriangle& t, std::uint32_t index, float left, float right,
             float to_border_w);
    void pad();

    int count_ = 0;
    std::vector<PieceBlock> blocks_;
    std::vector<PieceBounds> bounds_;
};

}  // namespace sonarsim
