#include "visibility/slices/narrow_pieces.h"

#include <algorithm>

namespace sonarsim {

namespace {

constexpr int slices_per_piece = 4;

}  // namespace

std::vector<WantedSlice> slices_through_narrow_pieces(const SliceScene& scene,
                                                      const SliceFrame& frame) {
    const std::vector<Slice>& slices = frame.slices;
    const auto gap_of = [&](float u) {
        const auto behind = std::ranges::upper_bound(slices, u, {}, &Slice::u);
        return static_cast<std::ptrdiff_t>(behind - slices.begin()) - 1;
    };
    const auto gaps = static_cast<std::ptrdiff_t>(frame.gaps());
    std::vector<WantedSlice> wanted;
    for (const Extent& piece : scene.piece_u) {
        if (!(piece.from < piece.to)) continue;  // out of view
        const std::ptrdiff_t gap = gap_of(piece.from);
        const float width = piece.to - piece.from;
        if (gap < 0 || gap >= gaps || width > slices[gap + 1].u - slices[gap].u) continue;
        for (int k = 0; k < slices_per_piece; ++k) {
            const float u = piece.from + (static_cast<float>(k) + 0.5F) * width / slices_per_piece;
            const std::ptrdiff_t at = gap_of(u);
            if (at < gaps) wanted.push_back({static_cast<std::uint32_t>(at), u});
        }
    }
    std::ranges::sort(wanted, {}, &WantedSlice::u);
    return wanted;
}

}  // namespace sonarsim
