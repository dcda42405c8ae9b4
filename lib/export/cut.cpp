#include "export/cut.h"

#include <algorithm>

namespace sonarsim {

namespace {

/// Joins pixels [begin, end) of a picture, in columns from the top, into a mask.
class MaskBuilder {
  public:
    explicit MaskBuilder(int height) : height_(height) {}

    /// Adds pixels of one column, which come after all that were added.
    void add(std::uint64_t begin, std::uint64_t end) {
        const auto x = static_cast<int>(begin / height_);
        const auto top = static_cast<int>(begin % height_);
        const int bottom = top + static_cast<int>(end - begin);
        if (mask_.area == 0) mask_.left = x, mask_.top = top;
        mask_.right = x + 1;
        mask_.top = std::min(mask_.top, top);
        mask_.bottom = std::max(mask_.bottom, bottom);
        mask_.area += end - begin;
        if (begin == end_ && !mask_.runs.empty()) {
            mask_.runs.back() += static_cast<std::uint32_t>(end - begin);
        } else {
            mask_.runs.push_back(static_cast<std::uint32_t>(begin - end_));
            mask_.runs.push_back(static_cast<std::uint32_t>(end - begin));
        }
        end_ = end;
    }

    ObjectMask finish(std::uint64_t pixels) {
        if (end_ < pixels) mask_.runs.push_back(static_cast<std::uint32_t>(pixels - end_));
        return std::move(mask_);
    }

  private:
    std::uint64_t height_;
    std::uint64_t end_ = 0;  ///< the end of the last pixels
    ObjectMask mask_;
};

/// Calls `visit` with each run of the mask in a column: column, first row, row after the last.
template <class Visit>
void for_each_run(std::span<const std::uint32_t> runs, int height, int from, int to,
                  const Visit& visit) {
    const auto rows = static_cast<std::uint64_t>(height);
    std::uint64_t at = 0;
    bool inside = false;
    for (const std::uint32_t run : runs) {
        const std::uint64_t end = at + run;
        std::uint64_t column = std::max(at / rows, static_cast<std::uint64_t>(from));
        for (; inside && column < static_cast<std::uint64_t>(to) && column * rows < end; ++column) {
            const std::uint64_t begin = std::max(at, column * rows) - column * rows;
            const std::uint64_t stop = std::min(end, (column + 1) * rows) - column * rows;
            if (begin < stop) {
                visit(static_cast<int>(column), static_cast<int>(begin), static_cast<int>(stop));
            }
        }
        at = end;
        inside = !inside;
        if (at >= static_cast<std::uint64_t>(to) * rows) return;
    }
}

}  // namespace

PixelBox box_of(const ObjectMask& mask) {
    return {mask.left, mask.right, mask.top, mask.bottom};
}

std::optional<PixelBox> cut_box(const PixelBox& box, const Frame& frame, int from, int to) {
    const PixelBox cut{std::max({box.left, frame.left, from}) - frame.left,
                       std::min({box.right, frame.right, to}) - frame.left,
                       std::max(box.top, frame.top) - frame.top,
                       std::min(box.bottom, frame.bottom) - frame.top};
    if (cut.left >= cut.right || cut.top >= cut.bottom) return std::nullopt;
    return cut;
}

ObjectMask mask_of_runs(std::span<const std::uint32_t> runs, int height) {
    std::uint64_t pixels = 0;
    for (const std::uint32_t run : runs)
        pixels += run;
    const auto columns = static_cast<int>(pixels / static_cast<std::uint64_t>(height));
    ObjectMask whole;
    whole.runs.assign(runs.begin(), runs.end());
    return cut_mask(whole, height, {0, columns, 0, height}, 0, columns);
}

ObjectMask cut_mask(const ObjectMask& mask, int height, const Frame& frame, int from, int to) {
    MaskBuilder builder(frame.height());
    const auto rows = static_cast<std::uint64_t>(frame.height());
    for_each_run(mask.runs, height, std::max(from, frame.left), std::min(to, frame.right),
                 [&](int column, int begin, int end) {
                     begin = std::max(begin, frame.top) - frame.top;
                     end = std::min(end, frame.bottom) - frame.top;
                     if (begin >= end) return;
                     const std::uint64_t top =
                         static_cast<std::uint64_t>(column - frame.left) * rows;
                     builder.add(top + static_cast<std::uint64_t>(begin),
                                 top + static_cast<std::uint64_t>(end));
                 });
    ObjectMask cut = builder.finish(rows * static_cast<std::uint64_t>(frame.width()));
    cut.id = mask.id;
    return cut;
}

std::vector<int> tile_begins(int length, int side, int overlap) {
    std::vector<int> begins{0};
    while (begins.back() + side < length)
        begins.push_back(std::min(begins.back() + side - overlap, length - side));
    return begins;
}

}  // namespace sonarsim
