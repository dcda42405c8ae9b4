#include "simulate/product/picture.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace sonarsim {

namespace {

// A font of capitals, digits and a few signs on a 5 x 7 grid, for labels in raster images.

inline constexpr int glyph_columns = 5;
inline constexpr int glyph_rows = 7;
inline constexpr int glyph_step = 6;  ///< distance between letters, pixels

/// Rows from top to bottom; bit 4 of a row is the leftmost pixel.
using Glyph = std::array<std::uint8_t, glyph_rows>;

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,:=-_/%()^+";

constexpr std::array<Glyph, letters.size()> glyphs{{
    {0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11},  // A
    {0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e},  // B
    {0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e},  // C
    {0x1e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1e},  // D
    {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f},  // E
    {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10},  // F
    {0x0e, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0e},  // G
    {0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11},  // H
    {0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e},  // I
    {0x07, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0c},  // J
    {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11},  // K
    {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f},  // L
    {0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11},  // M
    {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11},  // N
    {0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e},  // O
    {0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10},  // P
    {0x0e, 0x11, 0x11, 0x11, 0x15, 0x12, 0x0d},  // Q
    {0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11},  // R
    {0x0f, 0x10, 0x10, 0x0e, 0x01, 0x01, 0x1e},  // S
    {0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04},  // T
    {0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e},  // U
    {0x11, 0x11, 0x11, 0x11, 0x11, 0x0a, 0x04},  // V
    {0x11, 0x11, 0x11, 0x15, 0x15, 0x1b, 0x11},  // W
    {0x11, 0x11, 0x0a, 0x04, 0x0a, 0x11, 0x11},  // X
    {0x11, 0x11, 0x0a, 0x04, 0x04, 0x04, 0x04},  // Y
    {0x1f, 0x01, 0x02, 0x04, 0x08, 0x10, 0x1f},  // Z
    {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e},  // 0
    {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e},  // 1
    {0x0e, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1f},  // 2
    {0x1e, 0x01, 0x01, 0x0e, 0x01, 0x01, 0x1e},  // 3
    {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02},  // 4
    {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e},  // 5
    {0x0e, 0x10, 0x10, 0x1e, 0x11, 0x11, 0x0e},  // 6
    {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08},  // 7
    {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e},  // 8
    {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x01, 0x0e},  // 9
    {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c},  // .
    {0x00, 0x00, 0x00, 0x00, 0x0c, 0x04, 0x08},  // ,
    {0x00, 0x0c, 0x0c, 0x00, 0x0c, 0x0c, 0x00},  // :
    {0x00, 0x00, 0x1f, 0x00, 0x1f, 0x00, 0x00},  // =
    {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00},  // -
    {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x1f},  // _
    {0x01, 0x01, 0x02, 0x04, 0x08, 0x10, 0x10},  // /
    {0x19, 0x19, 0x02, 0x04, 0x08, 0x13, 0x13},  // %
    {0x02, 0x04, 0x08, 0x08, 0x08, 0x04, 0x02},  // (
    {0x08, 0x04, 0x02, 0x02, 0x02, 0x04, 0x08},  // )
    {0x04, 0x0a, 0x11, 0x00, 0x00, 0x00, 0x00},  // ^
    {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00},  // +
}};

constexpr Glyph no_glyph{};

/// The glyph of a letter; blank if the font lacks it. Small letters are drawn as capitals.
const Glyph& glyph_of(char letter) {
    const bool small = letter >= 'a' && letter <= 'z';
    const std::size_t i = letters.find(small ? static_cast<char>(letter - 'a' + 'A') : letter);
    return i == std::string_view::npos ? no_glyph : glyphs[i];
}

/// The small m of the metre, the font's only small letter.
constexpr Glyph metre{0x00, 0x00, 0x1a, 0x15, 0x15, 0x15, 0x15};

/// The largest power of ten that is at most `value`.
double power_of_ten_in(double value) {
    double power = 1.0;
    while (power > value)
        power /= 10.0;
    while (power * 10.0 <= value)
        power *= 10.0;
    return power;
}

}  // namespace

Rgb blend(std::span<const Rgb> stops, float share) {
    const auto last = static_cast<float>(stops.size() - 1);
    const float at = std::clamp(share, 0.0F, 1.0F) * last;
    const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const float part = at - static_cast<float>(i);
    const auto mix = [&](std::uint8_t a, std::uint8_t b) {
        const auto from = static_cast<float>(a);
        const auto to = static_cast<float>(b);
        return static_cast<std::uint8_t>(from + part * (to - from) + 0.5F);
    };
    const Rgb& a = stops[i];
    const Rgb& b = stops[i + 1];
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

Picture::Picture(int w, int h, Rgb colour)
    : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, colour) {}

void fill(Picture& picture, int x, int y, int width, int height, Rgb colour) {
    const int x1 = std::min(x + width, picture.width);
    const int y1 = std::min(y + height, picture.height);
    for (int j = std::max(y, 0); j < y1; ++j) {
        for (int i = std::max(x, 0); i < x1; ++i)
            picture.row(j)[i] = colour;
    }
}

int text_width(std::string_view text) {
    return text.empty() ? 0 : static_cast<int>(text.size()) * glyph_step - 1;
}

void write(Picture& picture, int x, int y, std::string_view text, Align align, Rgb colour) {
    const int width = text_width(text);
    int left = align == Align::left ? x : align == Align::right ? x - width : x - width / 2;
    for (const char letter : text) {
        const Glyph& glyph = letter == 'm' ? metre : glyph_of(letter);
        for (int j = 0; j < glyph_rows; ++j) {
            for (int i = 0; i < glyph_columns; ++i) {
                const bool set = glyph[j] >> (glyph_columns - 1 - i) & 1;
                if (set) fill(picture, left + i, y + j, 1, 1, colour);
            }
        }
        left += glyph_step;
    }
}

double round_up_125(double value) {
    const double power = power_of_ten_in(value);
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (power * factor >= value) return power * factor;
    }
    return power * 10.0;
}

double round_down_125(double value) {
    const double power = power_of_ten_in(value);
    for (const double factor : {5.0, 2.0}) {
        if (power * factor <= value) return power * factor;
    }
    return power;
}

std::vector<double> axis_marks(double low, double high, double wanted) {
    std::vector<double> marks;
    if (!(low < high)) return marks;
    const double step = round_up_125((high - low) / wanted);
    // Dividing by a whole number gives the doubles nearest to the decimals.
    const double per_step = std::round(1.0 / step);
    const double first = std::ceil(low / step);
    // Far from 0 neighbouring marks may be the same double; then there are no marks.
    if (first + 1.0 == first) return marks;
    for (double k = first; k * step <= high; ++k)
        marks.push_back((step < 1.0 ? k / per_step : k * step) + 0.0);
    return marks;
}

}  // namespace sonarsim
