#include "visibility/slices/narrow_components.h"

#include <algorithm>

namespace sonarsim {

namespace {

constexpr int slices_per_component = 4;

}  // namespace

std::vector<RequestedSlice> slices_through_narrow_components(const SliceScene& scene,
                                                             const SliceFrame& frame) {
    const std::vector<Slice>& slices = frame.slices;
    const auto gap_of = [&](float u) {
        const auto behind = std::ranges::upper_bound(slices, u, {}, &Slice::u);
        return static_cast<std::ptrdiff_t>(behind - slices.begin()) - 1;
    };
    const auto gaps = static_cast<std::ptrdiff_t>(frame.gaps());
    std::vector<RequestedSlice> requested;
    for (const Interval& component : scene.component_u) {
        if (!(component.from < component.to)) continue;  // out of view
        const std::ptrdiff_t gap = gap_of(component.from);
        const float width = component.to - component.from;
        if (gap < 0 || gap >= gaps || width > slices[gap + 1].u - slices[gap].u) continue;
        for (int k = 0; k < slices_per_component; ++k) {
            const float u =
                component.from + (static_cast<float>(k) + 0.5F) * width / slices_per_component;
            const std::ptrdiff_t at = gap_of(u);
            if (at < gaps) requested.push_back({static_cast<std::uint32_t>(at), u});
        }
    }
    std::ranges::sort(requested, {}, &RequestedSlice::u);
    return requested;
}

}  // namespace sonarsim
