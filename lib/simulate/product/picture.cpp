#include "simulate/product/picture.h"

#include <algorithm>
#include <cmath>

#include "simulate/product/glyphs.h"

namespace sonarsim {

namespace {

/// The small m of the metre, the font's only small letter.
constexpr Glyph metre{0x00, 0x00, 0x1a, 0x15, 0x15, 0x15, 0x15};

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

namespace {

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
