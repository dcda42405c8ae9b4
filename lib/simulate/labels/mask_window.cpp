#include <iterator>
#include <map>
#include <utility>

#include "simulate/labels/silhouette.h"

namespace sonarsim {

MaskFrame frame_of(const View& view, const ResolutionCell& cell) {
    const bool is_fan = view.shape == ViewShape::fan;
    return {view.beams,
            view.range_bins,
            cell,
            is_fan ? view.azimuth_rad / view.beams : 0.0,
            is_fan ? view.range_min_m / view.bin_m() : 0.0,
            is_full_turn(view)};
}

namespace {

/// Counts an object's lines beyond the seam of a full turn on over it, from the largest gap.
void unwrap(const MaskFrame& frame, std::span<const std::uint16_t> ids, MaskWindow& box) {
    if (!frame.full_turn || box.line > 0 || box.lines < frame.lines) return;
    int gap = 0;
    int empty = 0;
    for (int line = 0; line < frame.lines; ++line) {
        const auto bins = ids.subspan(static_cast<std::size_t>(line) * frame.bins, frame.bins);
        empty = std::ranges::find(bins, box.id) == bins.end() ? empty + 1 : 0;
        if (empty <= gap) continue;
        gap = empty;
        box.line = line + 1 - frame.lines;
    }
    box.lines -= gap;
}

}  // namespace

void MaskWindow::sum_within(const CellReach& reach) {
    const auto along = [&](int count, int stride, int steps) {
        const std::vector<float> from = values;
        for (int k = 0; steps > 0 && k < std::ssize(from); ++k) {
            const int at = k / stride % count;
            const int last = std::min(steps, count - 1 - at);
            float sum = 0.0F;
            for (int d = std::max(-steps, -at); d <= last; ++d)
                sum += from[k + d * stride];
            values[k] = sum;
        }
    };
    along(bins, 1, reach.bins);
    along(lines, bins, reach.lines);
}

std::vector<int> MaskWindow::flood(int k, float value, bool diagonal) {
    const float old = std::exchange(values[k], value);
    std::vector<int> found{k};
    for (std::size_t next = 0; next < found.size(); ++next) {
        const int j0 = found[next] / bins;
        const int i0 = found[next] % bins;
        for (int j = std::max(j0 - 1, 0); j < std::min(j0 + 2, lines); ++j) {
            for (int i = std::max(i0 - 1, 0); i < std::min(i0 + 2, bins); ++i) {
                const int at = j * bins + i;
                if (values[at] != old || (!diagonal && j != j0 && i != i0)) continue;
                values[at] = value;
                found.push_back(at);
            }
        }
    }
    return found;
}

std::vector<MaskWindow> windows_of(const MaskFrame& frame, const CellReach& reach,
                                   std::span<const std::uint16_t> ids) {
    std::map<std::uint16_t, MaskWindow> boxes;
    const auto add = [&](std::uint16_t id, int line, int bin) {
        if (id == 0) return;
        MaskWindow& box = boxes.try_emplace(id, MaskWindow{id, line, bin}).first->second;
        box.bins = std::max(box.bin + box.bins, bin + 1) - std::min(box.bin, bin);
        box.bin = std::min(box.bin, bin);
        box.lines = line + 1 - box.line;
    };
    // Most bins are empty, and the loop over a stretch vectorises.
    constexpr std::size_t stretch = 64;
    for (std::size_t first = 0; first < ids.size(); first += stretch) {
        const std::span some = ids.subspan(first, std::min(stretch, ids.size() - first));
        std::uint16_t any = 0;
        for (const std::uint16_t id : some)
            any |= id;
        for (std::size_t k = 0; any != 0 && k < some.size(); ++k) {
            const auto at = static_cast<int>(first + k);
            add(some[k], at / frame.bins, at % frame.bins);
        }
    }
    const int more_lines = 2 * reach.lines + 1;
    const int more_bins = 2 * reach.bins + 1;
    std::vector<MaskWindow> out;
    for (auto& [id, box] : boxes) {
        unwrap(frame, ids, box);
        MaskWindow& window =
            out.emplace_back(MaskWindow{id, box.line - more_lines, box.bin - more_bins,
                                        box.lines + 2 * more_lines, box.bins + 2 * more_bins});
        window.values.resize(static_cast<std::size_t>(window.lines) * window.bins);
        window.for_each(
            frame, [&](float& value, std::size_t k) { value = ids[k] == window.id ? 1.0F : 0.0F; });
    }
    return out;
}

}  // namespace sonarsim
