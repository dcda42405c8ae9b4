#include "run/preview/fan_style.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/elementary.h"
#include "core/text.h"
#include "core/units.h"
#include "run/preview/drawing.h"

namespace sonarsim {

namespace {

constexpr float line_share = 0.45F;
constexpr int min_px = 160;  // a smaller fan has no room for numbers

/// The step between lines of equal azimuth, degrees, for at most ten lines.
double bearing_step_deg(double azimuth_deg) {
    for (const double step : {1.0, 2.0, 5.0, 10.0, 15.0, 30.0}) {
        if (azimuth_deg <= 9.0 * step) return step;
    }
    return 45.0;
}

std::vector<double> ring_ranges(const View& view) {
    std::vector<double> ranges = axis_marks(view.range_min_m, view.range_max_m, 5.0);
    std::erase(ranges, 0.0);
    return ranges;
}

std::vector<double> bearings_deg(const View& view) {
    const double azimuth_deg = degrees(view.azimuth_rad);
    const double step = bearing_step_deg(azimuth_deg);
    const int last = static_cast<int>(std::floor(0.5 * azimuth_deg / step + 1e-9));
    std::vector<double> bearings;
    for (int k = -last; k <= last; ++k)
        bearings.push_back(k * step);
    // In a full turn the first and the last line are both astern.
    if (azimuth_deg >= 360.0 && bearings.size() > 1) bearings.erase(bearings.begin());
    return bearings;
}

/// The weight of a smooth line of one pixel whose middle is `pixels` away.
float cover(double pixels) {
    return line_share * static_cast<float>(std::max(0.0, 1.0 - std::fabs(pixels)));
}

void draw_lines(Picture& picture, const FanFrame& frame, const View& view) {
    const std::vector<double> ranges = ring_ranges(view);
    const std::vector<double> bearings = bearings_deg(view);
    for (int row = 0; row < frame.height; ++row) {
        for (int column = 0; column < frame.width; ++column) {
            const FanPlace place = fan_place(frame, view.range_max_m, column, row);
            if (!is_inside_sector(view, place)) continue;
            float share = 0.0F;
            for (const double range : ranges)
                share = std::max(share, cover((place.range_m - range) / frame.pixel_m));
            for (const double bearing : bearings) {
                const SinCos off = sincos(place.azimuth_rad - radians(bearing));
                if (off.cos > 0.0)
                    share = std::max(share, cover(place.range_m * off.sin / frame.pixel_m));
            }
            if (share > 0.0F) tint(picture, column, row, mark_colour, share);
        }
    }
}

struct Pixel {
    int x;
    int y;
};

Pixel pixel_of(const FanFrame& frame, const View& view, double range_m, double azimuth_rad) {
    const SinCos at = sincos(azimuth_rad);
    return {static_cast<int>(std::floor(0.5 * frame.width - range_m * at.sin / frame.pixel_m)),
            static_cast<int>(std::floor((view.range_max_m - range_m * at.cos) / frame.pixel_m))};
}

/// Writes a number within the picture.
void write_number(Picture& picture, const Pixel& at, const std::string& text) {
    const int half = text_width(text) / 2 + 1;
    const int x = std::clamp(at.x, half, std::max(half, picture.width - half));
    const int y = std::clamp(at.y, 5, std::max(5, picture.height - 5));
    outlined_label(picture, x, y, text, Align::middle, mark_colour);
}

void write_numbers(Picture& picture, const FanFrame& frame, const View& view) {
    const bool wide = view.azimuth_rad > pi;
    for (const double range_m : ring_ranges(view)) {
        if (range_m > 0.97 * view.range_max_m) continue;  // the outermost bearing has its number
        const std::string text = number_text(range_m) + " m";
        Pixel at = pixel_of(frame, view, range_m, wide ? 0.0 : -0.5 * view.azimuth_rad);
        at.x += 5 + text_width(text) / 2;
        at.y += wide ? 6 : 2;
        write_number(picture, at, text);
    }
    const double in_m = 14.0 * frame.pixel_m;
    for (const double bearing : bearings_deg(view)) {
        const char* side = bearing > 0.0 && bearing < 180.0 ? "P" : bearing < 0.0 ? "S" : "";
        write_number(picture, pixel_of(frame, view, view.range_max_m - in_m, radians(bearing)),
                     number_text(std::fabs(bearing)) + side);
    }
}

}  // namespace

Picture styled_fan(const Sonar& sonar, const FanFrame& frame, std::span<const std::uint8_t> grey) {
    Picture picture(frame.width, frame.height, backdrop);
    for (std::size_t k = 0; k < grey.size(); ++k)
        picture.pixels[k] = blend(amber_colours, static_cast<float>(grey[k]) / 255.0F);
    const View& view = sonar.settings.view;
    draw_lines(picture, frame, view);
    if (std::min(frame.width, frame.height) >= min_px) write_numbers(picture, frame, view);
    return picture;
}

}  // namespace sonarsim
