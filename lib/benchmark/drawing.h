#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace sonarsim {

// A drawing is a list of simple shapes that can be written as SVG and as pixels alike. Pixels are
// the unit, the origin is at the top left. Later shapes lie above earlier ones.

using Colour = std::array<std::uint8_t, 3>;

struct Line {
    double x0, y0, x1, y1;
    double width;
    Colour colour;
};

struct Disc {
    double x, y;
    double radius;
    double ring;  ///< width of the ring; 0: filled
    Colour colour;
};

enum class Anchor { start, middle, end };

struct Label {
    double x, y;  ///< of the anchor, on the baseline
    std::string text;
    Anchor anchor;
    Colour colour;
};

struct Drawing {
    int width = 0;
    int height = 0;
    std::vector<std::variant<Line, Disc, Label>> shapes;
};

/// The drawing as an SVG file on white.
std::string svg_text(const Drawing& drawing);

/// The drawing as pixels on white, [height, width, 3]. Letters are set as capitals; what the font
/// lacks is left blank.
std::vector<std::uint8_t> raster(const Drawing& drawing);

}  // namespace sonarsim
