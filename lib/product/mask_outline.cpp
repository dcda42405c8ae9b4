#include "product/mask_outline.h"

#include <cstddef>
#include <cstdint>

namespace sonarsim {

namespace {

enum Heading { right, down, left, up };  // a right turn adds 1

constexpr Corner step_of[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
// The pixels ahead of a corner, as offsets from the pixel whose upper left corner it is.
constexpr Corner right_ahead[] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
constexpr Corner left_ahead[] = {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}};

/// The pixels of a mask within its box.
class BoxPixels {
  public:
    BoxPixels(const ObjectMask& mask, int height)
        : left_(mask.left),
          top_(mask.top),
          width_(mask.right - mask.left),
          height_(mask.bottom - mask.top),
          inside_(static_cast<std::size_t>(width_) * height_, 0),
          walked_(inside_.size(), 0) {
        std::size_t at = 0;
        bool in = false;
        for (const std::uint32_t run : mask.runs) {
            for (std::size_t k = at; in && k < at + run; ++k) {
                const int x = static_cast<int>(k / height);
                const int y = static_cast<int>(k % height);
                inside_[index(x, y)] = 1;
            }
            at += run;
            in = !in;
        }
    }

    bool is_inside(int x, int y) const {
        const bool in_box = x >= left_ && x < left_ + width_ && y >= top_ && y < top_ + height_;
        return in_box && inside_[index(x, y)] != 0;
    }

    /// True if an outline has run up the left side of this pixel.
    bool is_walked(int x, int y) const { return walked_[index(x, y)] != 0; }
    void walk(int x, int y) { walked_[index(x, y)] = 1; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - top_) * width_ + (x - left_);
    }

    int left_, top_, width_, height_;
    std::vector<std::uint8_t> inside_;
    std::vector<std::uint8_t> walked_;
};

/// Follows the outline that runs up the left side of a pixel, with the mask on its right.
std::vector<Corner> outline_from(BoxPixels& pixels, int x, int y) {
    std::vector<Corner> corners;
    const Corner start{x, y + 1};
    Corner at = start;
    int heading = up;
    do {
        if (heading == up) pixels.walk(at[0], at[1] - 1);
        at = {at[0] + step_of[heading][0], at[1] + step_of[heading][1]};
        const auto is_in = [&](const Corner& ahead) {
            return pixels.is_inside(at[0] + ahead[0], at[1] + ahead[1]);
        };
        const int before = heading;
        if (!is_in(right_ahead[before])) {
            heading = (before + 1) % 4;
        } else if (is_in(left_ahead[before])) {
            heading = (before + 3) % 4;
        }
        if (heading != before) corners.push_back(at);
    } while (at != start || heading != up);
    return corners;
}

/// Twice the area; positive for a clockwise outline.
std::int64_t doubled_area(const std::vector<Corner>& corners) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Corner& a = corners[k];
        const Corner& b = corners[(k + 1) % corners.size()];
        sum += std::int64_t{a[0]} * b[1] - std::int64_t{b[0]} * a[1];
    }
    return sum;
}

}  // namespace

std::vector<std::vector<Corner>> mask_outlines(const ObjectMask& mask, int height) {
    std::vector<std::vector<Corner>> outlines;
    BoxPixels pixels(mask, height);
    for (int y = mask.top; y < mask.bottom; ++y) {
        for (int x = mask.left; x < mask.right; ++x) {
            const bool begins = pixels.is_inside(x, y) && !pixels.is_inside(x - 1, y);
            if (!begins || pixels.is_walked(x, y)) continue;
            std::vector<Corner> outline = outline_from(pixels, x, y);
            if (doubled_area(outline) > 0) outlines.push_back(std::move(outline));
        }
    }
    return outlines;
}

std::vector<Corner> joined_outline(const std::vector<std::vector<Corner>>& parts) {
    std::vector<Corner> all;
    for (const std::vector<Corner>& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
        if (parts.size() > 1) all.push_back(part.front());
    }
    // Go back from the last part to the first, where the polygon closes.
    for (std::size_t k = parts.size(); k-- > 2;)
        all.push_back(parts[k - 1].front());
    return all;
}

}  // namespace sonarsim
