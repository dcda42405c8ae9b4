#include "simulate/visibility/strips/column_pieces.h"

namespace sonarsim {

namespace {

constexpr float nowhere = 1e30F;

/// The two shorter edges of a triangle, as far as they bound it between u = from and u = to.
std::array<PieceEnd, 2> short_edges(const StripTriangle& t, float from, float to, float middle) {
    const PieceEnd first{t.w0 + t.first_slope * (middle - t.u0), t.first_slope};
    const PieceEnd second{t.w1 + t.second_slope * (middle - t.u1), t.second_slope};
    if (t.no_first || (t.u1 <= from && !t.no_second)) return {second, second};
    if (t.no_second || t.u1 >= to) return {first, first};
    return {first, second};
}

}  // namespace

void ColumnPieces::gather(const std::vector<StripTriangle>& triangles,
                          std::span<const std::uint32_t> column_triangles, float left, float right,
                          float to_border_w) {
    count_ = 0;
    const std::size_t blocks = column_triangles.size() / lanes + 1;
    if (blocks_.size() < blocks) blocks_.resize(blocks + blocks / 2);
    for (const std::uint32_t index : column_triangles) {
        if (add(triangles[index], index, left, right, to_border_w)) ++count_;
    }
    pad();
}

/// Writes piece `count_`; returns false if it is out of view.
bool ColumnPieces::add(const StripTriangle& t, std::uint32_t index, float left, float right,
                       float to_border_w) {
    const float from = std::max(t.u0, left);
    const float to = std::min(t.u2, right);
    if (!(to > from)) return false;
    const float middle = 0.5F * (from + to);
    const float half = 0.5F * (to - from);
    const PieceEnd whole{t.w0 + t.long_slope * (middle - t.u0), t.long_slope};
    const auto [a, b] = short_edges(t, from, to, middle);
    const PieceEnd low_a = t.middle_above ? whole : a;
    const PieceEnd low_b = t.middle_above ? whole : b;
    const PieceEnd high_a = t.middle_above ? a : whole;
    const PieceEnd high_b = t.middle_above ? b : whole;
    const auto low_at = [&](float d) {
        return std::max(low_a.w + low_a.slope * d, low_b.w + low_b.slope * d);
    };
    const auto high_at = [&](float d) {
        return std::min(high_a.w + high_a.slope * d, high_b.w + high_b.slope * d);
    };
    const float low_from = low_at(-half);
    const float low_to = low_at(half);
    const float high_from = high_at(-half);
    const float high_to = high_at(half);
    const bool corner = t.u1 > from && t.u1 < to;
    const float at_corner_low = corner ? t.w1 : low_from;
    const float at_corner_high = corner ? t.w1 : high_from;
    const float w_min = std::max(t.w_min, std::min(std::min(low_from, low_to), at_corner_low));
    const float w_max = std::min(t.w_max, std::max(std::max(high_from, high_to), at_corner_high));
    if (w_min >= to_border_w || w_max <= -to_border_w) return false;
    const float w = 0.5F * (low_at(0.0F) + high_at(0.0F));
    const float q = t.q0 + t.q_u * (middle - t.u0) + t.q_w * (w - t.w0);
    const float across = t.q_u * half;
    float min_offset = std::min(t.q_w * (low_from - w), t.q_w * (high_from - w)) - across;
    float max_offset = std::max(t.q_w * (low_from - w), t.q_w * (high_from - w)) - across;
    min_offset =
        std::min(min_offset, std::min(t.q_w * (low_to - w), t.q_w * (high_to - w)) + across);
    max_offset =
        std::max(max_offset, std::max(t.q_w * (low_to - w), t.q_w * (high_to - w)) + across);
    if (corner) {
        const float at_corner = t.q_u * (t.u1 - middle) + t.q_w * (t.w1 - w);
        min_offset = std::min(min_offset, at_corner);
        max_offset = std::max(max_offset, at_corner);
    }
    PieceBlock& p = blocks_[count_ / lanes];
    const int k = count_ % lanes;
    p.from[k] = from;
    p.to[k] = to;
    p.middle[k] = middle;
    p.low_a[k] = low_a.w;
    p.low_a_slope[k] = low_a.slope;
    p.low_b[k] = low_b.w;
    p.low_b_slope[k] = low_b.slope;
    p.high_a[k] = high_a.w;
    p.high_a_slope[k] = high_a.slope;
    p.high_b[k] = high_b.w;
    p.high_b_slope[k] = high_b.slope;
    p.q[k] = q;
    p.q_u[k] = t.q_u;
    p.q_w[k] = t.q_w;
    p.w[k] = w;
    p.q_min[k] = std::max(t.q_min, q + min_offset);
    p.q_max[k] = std::min(t.q_max, q + max_offset);
    p.w_min[k] = w_min;
    p.w_max[k] = w_max;
    p.number[k] = static_cast<std::int32_t>(t.number);
    p.triangle[k] = index;
    return true;
}

/// Fills the last block with pieces that hide nothing, and finds the bounds of all blocks.
void ColumnPieces::pad() {
    const int blocks = (count_ + lanes - 1) / lanes;
    for (int i = count_; i < blocks * lanes; ++i) {
        PieceBlock& p = blocks_[i / lanes];
        const int k = i % lanes;
        p.from[k] = p.w_min[k] = nowhere;
        p.to[k] = p.w_max[k] = -nowhere;
        p.q_max[k] = -1.0F;
    }
    const int groups = (blocks + lanes - 1) / lanes;
    bounds_.resize(groups);
    for (int j = 0; j < groups * lanes; ++j) {
        PieceBounds& out = bounds_[j / lanes];
        const int k = j % lanes;
        out.from[k] = out.w_min[k] = nowhere;
        out.to[k] = out.w_max[k] = -nowhere;
        out.q_max[k] = -1.0F;
        if (j >= blocks) continue;
        const PieceBlock& p = blocks_[j];
        for (int i = 0; i < lanes; ++i) {
            out.from[k] = std::min(out.from[k], p.from[i]);
            out.to[k] = std::max(out.to[k], p.to[i]);
            out.w_min[k] = std::min(out.w_min[k], p.w_min[i]);
            out.w_max[k] = std::max(out.w_max[k], p.w_max[i]);
            out.q_max[k] = std::max(out.q_max[k], p.q_max[i]);
        }
    }
}

}  // namespace sonarsim
