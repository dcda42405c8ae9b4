#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "product/annotation.h"
#include "product/object_masks.h"

namespace sonarsim {

/// Columns [left, right) and rows [top, bottom) of a picture.
struct Frame {
    int left = 0, right = 0, top = 0, bottom = 0;

    int width() const { return right - left; }
    int height() const { return bottom - top; }
};

/// The box of a mask.
PixelBox box_of(const ObjectMask& mask);

/// The part of a box that lies in `frame` and in the columns [from, to), in pixels of the frame;
/// nothing if none does.
std::optional<PixelBox> cut_box(const PixelBox& box, const Frame& frame, int from, int to);

/// The mask of runs in a picture of this height, px, with its box and area. Its id is 0.
ObjectMask mask_of_runs(std::span<const std::uint32_t> runs, int height);

/// The part of a mask that lies in `frame` and in the columns [from, to), as a mask of a picture
/// that shows the frame alone. `height` is that of the picture that the mask is in. The area is 0
/// if nothing is left.
ObjectMask cut_mask(const ObjectMask& mask, int height, const Frame& frame, int from, int to);

/// The begins of tiles of `side` pixels along `length`: neighbours share `overlap` pixels, and the
/// last one ends with the length. One tile, at 0, if the length is not longer than a side.
std::vector<int> tile_begins(int length, int side, int overlap);

}  // namespace sonarsim
