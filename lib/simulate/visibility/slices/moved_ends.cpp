#include "simulate/visibility/slices/moved_ends.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

void move_ends(const Slice& slice, std::span<const VisibleSpan> spans, float u, MovedEnds& out) {
    out.u = u;
    std::vector<MovedEnd>& ends = out.ends;
    ends.resize(2 * spans.size());
    const float aside = u - slice.u;
    const float lowest = slice.w_low + slice.w_low_slope * aside;
    const float highest = slice.w_high + slice.w_high_slope * aside;
    const auto move = [&](float w, const Border& border, std::size_t i) {
        const float there = slice.widens ? u * std::sqrt(1.0F + w * w) : u;
        const float to = std::clamp(there, border.extent.from, border.extent.to) - slice.u;
        const float free = w + border.slope * to;
        const float alone = std::clamp(free, lowest, highest);
        ends[i] = {w, alone, alone, border.q, static_cast<std::uint32_t>(i), 1.0F, alone};
        if (free == alone) return;
        const float at_slice = free < lowest ? slice.w_low : slice.w_high;
        const float before = std::fabs(at_slice - w);
        const float share = before / (before + std::fabs(free - alone));
        ends[i].stop = share;
        ends[i].w_stop = at_slice + share * (alone - at_slice);
    };
    for (std::size_t i = 0; i < spans.size(); ++i) {
        move(spans[i].w_low, spans[i].low, 2 * i);
        move(spans[i].w_high, spans[i].high, 2 * i + 1);
    }
    for (std::size_t i = 1; i < ends.size(); ++i) {
        std::size_t first = i;  // first of the ends that move to one place
        while (first > 0 && ends[first - 1].w > ends[i].w && ends[first - 1].q <= ends[i].q)
            --first;
        const bool stopped = first > 0 && ends[first - 1].w > ends[i].w;
        if (first == i && !stopped) continue;
        const MovedEnd leader = ends[stopped ? first - 1 : i];
        for (std::size_t k = first; k <= i; ++k) {
            ends[k].w = leader.w;
            ends[k].q = leader.q;
            ends[k].follows = leader.follows;
            ends[k].stop = 1.0F;
            ends[k].w_stop = leader.w;
        }
    }
}

}  // namespace sonarsim
