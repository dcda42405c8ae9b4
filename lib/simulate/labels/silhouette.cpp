#include "simulate/labels/silhouette.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "simulate/labels/outline_hull.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;

/// The reach of gaps that are closed.
CellReach closing_reach(const ResolutionCell& cell) {
    return CellReach({std::max(cell.range_bins, 2.0), std::max(cell.beams, 2.0)});
}

/// Replaces each value by 1 if the sum of those within reach is at least `least`, else by 0.
void sum_and_compare(MaskWindow& window, const CellReach& reach, float least) {
    window.sum_within(reach);
    for (float& value : window.values)
        value = value >= least ? 1.0F : 0.0F;
}

/// Closes the gaps of a shape of ones, fills its holes and keeps the pieces for which keep(bins) is
/// true. The margin of the window must be empty.
template <class Keep>
void tidy(MaskWindow& shape, const CellReach& reach, Keep keep) {
    sum_and_compare(shape, reach, 1.0F);
    sum_and_compare(shape, reach, reach.count());
    constexpr float outside = 2.0F;
    constexpr float kept = 3.0F;
    shape.flood(0, outside, false);
    for (float& value : shape.values)
        value = value == outside ? 0.0F : 1.0F;
    for (int k = 0; k < std::ssize(shape.values); ++k) {
        if (shape.values[k] != 1.0F) continue;
        const std::vector<int> piece = shape.flood(k, kept, true);
        if (keep(piece)) continue;
        for (const int at : piece)
            shape.values[at] = 0.0F;
    }
}

}  // namespace

Ids find_bodies(const ExpectedBins& ping, std::span<const float> noise, float least_ratio) {
    const ResolutionCell& cell = ping.frame.cell;
    const CellReach reach(cell);
    const auto scale = static_cast<float>(cell.range_bins * cell.beams) / reach.count();
    Ids out(ping.object.size());
    for (auto& [id, window] : windows_of(ping.frame, reach, ping.object)) {
        const std::uint16_t object = id;
        window.for_each(ping.frame, [&](float& more, std::size_t k) {
            if (ping.object[k] != object) return;
            const float rest = std::max(ping.whole[k] - ping.echo[k], 0.0F);
            more = scale * (ping.echo[k] - least_ratio * rest);
        });
        window.sum_within(reach);
        window.for_each(ping.frame, [&](float more, std::size_t k) {
            const float bare = noise.empty() ? 0.0F : noise[k % ping.frame.bins];
            if (ping.object[k] == object && more >= least_ratio * bare) out[k] = object;
        });
    }
    return out;
}

void add_bright(const MaskFrame& frame, const Ids& bright, Ids& bodies) {
    const CellReach reach({3.0, frame.lines > 1 ? 3.0 : 1.0});
    Ids both = bodies;
    for (std::size_t k = 0; k < both.size(); ++k) {
        if (both[k] == 0) both[k] = bright[k];
    }
    for (auto& [id, shape] : windows_of(frame, reach, both)) {
        const std::uint16_t object = id;
        shape.for_each(
            frame, [&](float& value, std::size_t k) { value = both[k] == object ? 1.0F : 0.0F; });
        sum_and_compare(shape, reach, reach.count());
        sum_and_compare(shape, reach, 1.0F);
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value != 0.0F && both[k] == object) bodies[k] = object;
        });
    }
}

Ids outlined(const MaskFrame& frame, const Ids& ids) {
    const CellReach half_cell(frame.cell);
    const CellReach reach = closing_reach(frame.cell);
    Ids out(ids.size());
    const CellReach margin(
        {2.0 * (reach.bins + half_cell.bins), 2.0 * (reach.lines + half_cell.lines)});
    for (auto& [id, shape] : windows_of(frame, margin, ids)) {
        const std::uint16_t object = id;
        shape.for_each(
            frame, [&](float& value, std::size_t k) { value = ids[k] == object ? 1.0F : 0.0F; });
        sum_and_compare(shape, half_cell, 1.0F);
        tidy(shape, reach, [&](const std::vector<int>& piece) {
            return static_cast<float>(piece.size()) >= half_cell.count();
        });
        fill_hulls(frame, shape);
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value != 0.0F && (ids[k] == 0 || ids[k] == object) && out[k] == 0) out[k] = object;
        });
    }
    return out;
}

void drop_mirror_images(const MaskFrame& frame, std::span<const std::uint16_t> visible, Ids& ids) {
    constexpr float found = 2.0F;
    for (auto& [id, shape] : windows_of(frame, CellReach({}), ids)) {
        const std::uint16_t object = id;
        MaskWindow kept = shape;
        shape.for_each(
            frame, [&](float& value, std::size_t k) { value = ids[k] == object ? 1.0F : 0.0F; });
        kept.for_each(frame, [&](float& value, std::size_t k) {
            value = visible[k] == object ? 1.0F : 0.0F;
        });
        for (int k = 0; k < std::ssize(shape.values); ++k) {
            if (shape.values[k] == 1.0F && kept.values[k] == 1.0F) shape.flood(k, found, true);
        }
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value == 1.0F) ids[k] = 0;
        });
    }
}

Ids with_shadows(const MaskFrame& frame, const Ids& ids, const Ids& shadow,
                 std::span<const std::uint8_t> has_shadow) {
    const CellReach reach = closing_reach(frame.cell);
    const float least = CellReach(frame.cell).count();
    Ids both = ids;
    for (std::size_t k = 0; k < both.size(); ++k) {
        if (both[k] == 0 && has_shadow[shadow[k]] != 0) both[k] = shadow[k];
    }
    Ids out = ids;
    for (auto& [id, shape] : windows_of(frame, reach, both)) {
        const std::uint16_t object = id;
        if (has_shadow[object] == 0) continue;
        const MaskWindow& window = shape;
        std::vector<char> has_object(shape.lines);
        shape.for_each(frame, [&](float& value, std::size_t k) {
            value = both[k] == object ? 1.0F : 0.0F;
            if (ids[k] == object) has_object[k / frame.bins - window.line] = 1;
        });
        tidy(shape, reach, [&](const std::vector<int>& piece) {
            return static_cast<float>(piece.size()) >= least &&
                   std::ranges::any_of(piece,
                                       [&](int k) { return has_object[k / window.bins] != 0; });
        });
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value != 0.0F && out[k] == 0) out[k] = object;
        });
    }
    return out;
}

}  // namespace sonarsim
