#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/rgb.h"

namespace sonarsim {

inline constexpr Rgb ink{235, 235, 235};          ///< axes and labels
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

/// Writes capitals, digits, signs and a small m, seven pixels high, with their upper edge at y and
/// the named end of the text at x.
void write(Picture& picture, int x, int y, std::string_view text, Align align, Rgb colour);

/// The width of a text in pixels.
int text_width(std::string_view text);

/// The marks of an axis over [low, high]: about `wanted` multiples of 1, 2 or 5 times a power of
/// ten.
std::vector<double> axis_marks(double low, double high, double wanted);

/// The least of the numbers ..., 0.2, 0.5, 1, 2, 5, 10, ... that is at least `value`, which must be
/// positive.
double round_up_125(double value);

/// The greatest of those numbers that is at most `value`, which must be positive.
double round_down_125(double value);

}  // namespace sonarsim
