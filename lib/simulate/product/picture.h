#pragma once

#include <span>

#include "core/rgb.h"
#include "input/mission/mission.h"

namespace sonarsim {

inline constexpr Rgb ink{235, 235, 235};  ///< axes and labels
inline constexpr Rgb backdrop{16, 16, 20};
inline constexpr Rgb mark_colour{120, 205, 235};  ///< rings, bearings and marks in a picture

/// The colour at `share` (0 to 1, clamped) of the way through equally spaced stops.
Rgb blend(std::span<const Rgb> stops, float share);

/// A picture in memory, row by row from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;  ///< [height, width]

    Picture(int w, int h, Rgb colour);
    Rgb* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
};

/// Fills a rectangle, clipped to the picture.
void fill(Picture& picture, int x, int y, int width, int height, Rgb colour);

enum class Align { left, middle, right };

/// Writes capitals, digits, signs and m, seven pixels high: upper edge at y, the named end at x.
void write(Picture& picture, int x, int y, std::string_view text, Align align, Rgb colour);

int text_width(std::string_view text);

/// The marks of an axis over [low, high]: about `wanted`, steps of 1, 2 or 5 times a power of ten.
std::vector<double> axis_marks(double low, double high, double wanted);

/// The least of ..., 0.2, 0.5, 1, 2, 5, 10, ... that is at least `value`, which must be positive.
double round_up_125(double value);

/// The greatest of those numbers that is at most `value`, which must be positive.
double round_down_125(double value);

/// A box of pixels: columns [left, right), rows [top, bottom). Empty where left = right.
struct PixelBox {
    int left = 0, right = 0, top = 0, bottom = 0;

    bool is_empty() const { return left == right; }
    bool operator==(const PixelBox&) const = default;
};

/// The smallest box around two boxes; an empty box adds nothing.
inline PixelBox joined(const PixelBox& one, const PixelBox& other) {
    if (one.is_empty()) return other;
    if (other.is_empty()) return one;
    return {std::min(one.left, other.left), std::max(one.right, other.right),
            std::min(one.top, other.top), std::max(one.bottom, other.bottom)};
}

// The equally spaced stops of colour maps, for blend(). Brightness grows from stop to stop.
inline constexpr Rgb copper_colours[] = {{0, 0, 0}, {107, 67, 42}, {204, 127, 81}, {255, 199, 127}};
inline constexpr Rgb amber_colours[] = {
    {0, 0, 0}, {96, 44, 0}, {196, 112, 8}, {255, 184, 48}, {255, 244, 208}};
inline constexpr Rgb sea_colours[] = {{10, 4, 36},    {62, 30, 112},  {44, 96, 146},
                                      {34, 154, 138}, {140, 208, 84}, {252, 238, 120}};

/// The layout of a strip: a picture of all pings of a sonar with an axis of ranges, px.
struct StripFrame {
    int axis_width = 0;   ///< 0: no axis on the left
    int axis_height = 0;  ///< 0: no axis on top
    int ping_px = 1;      ///< size of a ping
    int bin_px = 1;       ///< size of a range bin
    int width = 0;        ///< with the axis
    int height = 0;
};

/// The functions that draw a strip. The axis is on top of rows of pings, on the left of columns.
struct StripStyle {
    StripFrame (*frame)(const SonarConfig& config, int pings);
    /// The axis alone.
    Picture (*axis)(const SonarConfig& config, const StripFrame& frame);
    /// A row of values: a ping, or a range bin over all pings. `white` is the intensity of the
    /// brightest colour; `pixels` is the row without the axis on its left.
    void (*row)(std::span<const float> values, double white, const StripFrame& frame,
                std::span<Rgb> pixels);
};

}  // namespace sonarsim
