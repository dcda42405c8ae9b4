#include "dataset/fan_png.h"

#include "format/png.h"

namespace sonarsim {

FanPng make_fan_png(const Sonar& sonar, const OutputConfig& output) {
    FanPng png{make_fan_map(sonar, output.fan_width_px), std::nullopt};
    if (output.fan_style != FanStyleConfig{})
        png.style = make_fan_style(sonar, png.map.frame, output.fan_style);
    return png;
}

std::string fan_png_bytes(const FanPng& png, const Ping& ping, double full_scale) {
    const FanFrame& frame = png.map.frame;
    const std::vector<std::uint8_t> grey = render_fan(png.map, ping, full_scale);
    if (!png.style) return png_bytes(grey, frame.width, frame.height);
    const Picture picture = styled_fan(*png.style, grey);
    static_assert(sizeof(Rgb) == 3, "a row of colours is a row of pixels");
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(picture.pixels.data());
    return png_bytes({bytes, 3 * picture.pixels.size()}, frame.width, frame.height, 3);
}

double fan_png_bytes_at_most(const FanPng& png) {
    return png_bytes_at_most(png.map.frame.width, png.map.frame.height, png.style ? 3 : 1);
}

}  // namespace sonarsim
