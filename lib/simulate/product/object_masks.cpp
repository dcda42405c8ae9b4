#include "simulate/product/object_masks.h"

#include <algorithm>

namespace sonarsim {

namespace {

/// A mask while its runs are appended.
struct GrowingMask {
    ObjectMask mask;
    std::size_t end = 0;  ///< end of its last run

    void add(std::size_t from, std::size_t to, int height) {
        const auto h = static_cast<std::size_t>(height);
        const int left = static_cast<int>(from / h);
        const int right = static_cast<int>((to - 1) / h) + 1;
        const bool spans = right - left > 1;
        const int top = spans ? 0 : static_cast<int>(from % h);
        const int bottom = spans ? height : static_cast<int>((to - 1) % h) + 1;
        if (mask.area == 0) {
            mask.left = left;
            mask.top = top;
        }
        mask.right = right;
        mask.top = std::min(mask.top, top);
        mask.bottom = std::max(mask.bottom, bottom);
        mask.area += to - from;
        mask.runs.push_back(static_cast<std::uint32_t>(from - end));
        mask.runs.push_back(static_cast<std::uint32_t>(to - from));
        end = to;
    }
};

}  // namespace

std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height) {
    std::vector<GrowingMask> growing;
    std::vector<std::uint32_t> place_of_id;  // 1 + index into `growing`
    for (std::size_t from = 0, to = 0; from < ids.size(); from = to) {
        const std::uint16_t id = ids[from];
        to = end_of_run(ids, from);
        if (id == 0) continue;
        if (place_of_id.size() <= id) place_of_id.resize(id + std::size_t{1}, 0);
        if (place_of_id[id] == 0) {
            growing.emplace_back().mask.id = id;
            place_of_id[id] = static_cast<std::uint32_t>(growing.size());
        }
        growing[place_of_id[id] - 1].add(from, to, height);
    }
    std::vector<ObjectMask> masks;
    masks.reserve(growing.size());
    for (const std::uint32_t place : place_of_id) {
        if (place == 0) continue;
        GrowingMask& one = growing[place - 1];
        if (one.end < ids.size())
            one.mask.runs.push_back(static_cast<std::uint32_t>(ids.size() - one.end));
        masks.push_back(std::move(one.mask));
    }
    return masks;
}

}  // namespace sonarsim
