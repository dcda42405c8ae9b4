#include <algorithm>
#include <cmath>

#include "benchmark/drawing.h"
#include "product/glyphs.h"

namespace sonarsim {

namespace {

struct Canvas {
    int width;
    int height;
    std::vector<std::uint8_t> pixels;

    void blend(int x, int y, double cover, const Colour& colour) {
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint8_t& p = pixels[3 * (static_cast<std::size_t>(y) * width + x) + c];
            p = static_cast<std::uint8_t>(p + (colour[c] - p) * cover + 0.5);
        }
    }

    /// Blends every pixel of a box by how deep inside the shape `depth(x, y)` says it lies.
    template <class Depth>
    void fill(double x0, double y0, double x1, double y1, const Colour& colour, Depth depth) {
        for (int y = static_cast<int>(y0) - 2; y <= static_cast<int>(y1) + 2; ++y) {
            for (int x = static_cast<int>(x0) - 2; x <= static_cast<int>(x1) + 2; ++x) {
                const double cover = std::clamp(0.5 + depth(x + 0.5, y + 0.5), 0.0, 1.0);
                if (cover > 0.0) blend(x, y, cover, colour);
            }
        }
    }
};

void draw(Canvas& canvas, const Line& s) {
    const double dx = s.x1 - s.x0;
    const double dy = s.y1 - s.y0;
    const double square = std::max(dx * dx + dy * dy, 1e-12);
    const auto [left, right] = std::minmax(s.x0, s.x1);
    const auto [top, bottom] = std::minmax(s.y0, s.y1);
    canvas.fill(left, top, right, bottom, s.colour, [&](double x, double y) {
        const double t = std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / square, 0.0, 1.0);
        return 0.5 * s.width - std::hypot(x - s.x0 - t * dx, y - s.y0 - t * dy);
    });
}

void draw(Canvas& canvas, const Disc& s) {
    const double reach = s.radius + s.ring;
    canvas.fill(s.x - reach, s.y - reach, s.x + reach, s.y + reach, s.colour,
                [&](double x, double y) {
                    const double r = std::hypot(x - s.x, y - s.y);
                    return s.ring > 0.0 ? 0.5 * s.ring - std::fabs(r - s.radius) : s.radius - r;
                });
}

void draw(Canvas& canvas, const Label& s) {
    const int width = static_cast<int>(s.text.size()) * glyph_step - 1;
    const int shift = s.anchor == Anchor::start    ? 0
                      : s.anchor == Anchor::middle ? width / 2
                                                   : width;
    int x = static_cast<int>(s.x) - shift;
    for (const char c : s.text) {
        const Glyph& glyph = glyph_of(c);
        for (int row = 0; row < glyph_rows; ++row) {
            for (int column = 0; column < glyph_columns; ++column) {
                if (glyph[row] >> (glyph_columns - 1 - column) & 1) {
                    canvas.blend(x + column, static_cast<int>(s.y) - glyph_rows + row, 1.0,
                                 s.colour);
                }
            }
        }
        x += glyph_step;
    }
}

}  // namespace

std::vector<std::uint8_t> raster(const Drawing& drawing) {
    Canvas canvas{drawing.width, drawing.height,
                  std::vector<std::uint8_t>(
                      3 * static_cast<std::size_t>(drawing.width) * drawing.height, 255)};
    for (const auto& shape : drawing.shapes) {
        std::visit([&](const auto& s) { draw(canvas, s); }, shape);
    }
    return std::move(canvas.pixels);
}

}  // namespace sonarsim
