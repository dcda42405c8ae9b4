#include "product/fan_style.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/elementary.h"
#include "core/text.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr float line_share = 0.45F;
constexpr float halo_share = 0.6F;
constexpr int least_px = 160;  // a smaller fan has no room for numbers

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

void mark_lines(FanStyle& style, const View& view, const FanStyleConfig& config) {
    const std::vector<double> ranges = config.rings ? ring_ranges(view) : std::vector<double>{};
    const std::vector<double> bearings =
        config.bearings ? bearings_deg(view) : std::vector<double>{};
    const FanFrame& frame = style.frame;
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
            if (share > 0.0F)
                style.marks.push_back({row * frame.width + column, mark_colour, share});
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

/// The text in the small letters of product/picture.h.
std::string small_text(const FanNumber& number) {
    return number.value + (number.is_bearing ? number.side : " m");
}

FanNumber range_number(const FanFrame& frame, const View& view, double range_m) {
    const bool wide = view.azimuth_rad > pi;
    const Pixel at = pixel_of(frame, view, range_m, wide ? 0.0 : -0.5 * view.azimuth_rad);
    FanNumber number{at.x + 5, wide ? at.y + 6 : at.y + 2, number_text(range_m), "", false};
    number.x += text_width(small_text(number)) / 2;
    return number;
}

FanNumber bearing_number(const FanFrame& frame, const View& view, double bearing_deg) {
    const double in_m = 14.0 * frame.pixel_m;
    const Pixel at = pixel_of(frame, view, view.range_max_m - in_m, radians(bearing_deg));
    const char* side = "";
    if (bearing_deg > 0.0 && bearing_deg < 180.0) side = "P";
    if (bearing_deg < 0.0) side = "S";
    return {at.x, at.y, number_text(std::fabs(bearing_deg)), side, true};
}

/// Writes a number within the picture.
void write_inside(Picture& text, const FanNumber& number) {
    const std::string letters = small_text(number);
    const int width = text_width(letters);
    const int x = std::clamp(number.x - width / 2, 1, std::max(1, text.width - width - 1));
    const int y = std::clamp(number.y - 3, 1, std::max(1, text.height - 8));
    write(text, x, y, letters, Align::left, mark_colour);
}

/// Marks the text and a dark seam around it, so that it is legible on any picture.
void mark_text(FanStyle& style, const Picture& text) {
    const auto is_set = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < text.width && y < text.height &&
               text.pixels[static_cast<std::size_t>(y) * text.width + x] == mark_colour;
    };
    for (int y = 0; y < text.height; ++y) {
        for (int x = 0; x < text.width; ++x) {
            bool near = false;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i)
                    near = near || is_set(x + i, y + j);
            }
            if (!near) continue;
            const int index = y * text.width + x;
            is_set(x, y) ? style.marks.push_back({index, mark_colour, 1.0F})
                         : style.marks.push_back({index, backdrop, halo_share});
        }
    }
}

}  // namespace

std::vector<FanNumber> fan_numbers(const Sonar& sonar, const FanFrame& frame,
                                   const FanStyleConfig& config) {
    std::vector<FanNumber> numbers;
    const View& view = sonar.settings.view;
    if (std::min(frame.width, frame.height) < least_px) return numbers;
    if (config.rings) {
        for (const double range : ring_ranges(view)) {
            // The outermost bearing has its number there.
            const bool taken = config.bearings && range > 0.97 * view.range_max_m;
            if (!taken) numbers.push_back(range_number(frame, view, range));
        }
    }
    if (config.bearings) {
        for (const double bearing : bearings_deg(view))
            numbers.push_back(bearing_number(frame, view, bearing));
    }
    return numbers;
}

FanStyle make_fan_style(const Sonar& sonar, const FanFrame& frame, const FanStyleConfig& config,
                        bool numbers) {
    FanStyle style{frame, colour_table(config.colours), {}};
    mark_lines(style, sonar.settings.view, config);
    if (!numbers) return style;
    const std::vector<FanNumber> all = fan_numbers(sonar, frame, config);
    if (all.empty()) return style;
    Picture text(frame.width, frame.height, backdrop);
    for (const FanNumber& number : all)
        write_inside(text, number);
    mark_text(style, text);
    return style;
}

Picture styled_fan(const FanStyle& style, std::span<const std::uint8_t> grey) {
    Picture picture(style.frame.width, style.frame.height, backdrop);
    for (std::size_t k = 0; k < grey.size(); ++k)
        picture.pixels[k] = style.colours[grey[k]];
    for (const FanStyle::Mark& mark : style.marks) {
        Rgb& pixel = picture.pixels[static_cast<std::size_t>(mark.index)];
        const Rgb ends[] = {pixel, mark.colour};
        pixel = blend(ends, mark.share);
    }
    return picture;
}

}  // namespace sonarsim
