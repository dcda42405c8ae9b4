#include <spdlog/fmt/fmt.h>

#include "benchmark/drawing.h"

namespace sonarsim {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {
            out += "&gt;";
        } else {
            out += c;
        }
    }
    return out;
}

std::string hex(const Colour& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string svg(const Line& s) {
    return fmt::format(
        R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{:g}"/>)",
        s.x0, s.y0, s.x1, s.y1, hex(s.colour), s.width);
}

std::string svg(const Disc& s) {
    const std::string place =
        fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:g}")", s.x, s.y, s.radius);
    if (s.ring <= 0.0) return place + fmt::format(R"( fill="{}"/>)", hex(s.colour));
    return place +
           fmt::format(R"( fill="none" stroke="{}" stroke-width="{:g}"/>)", hex(s.colour), s.ring);
}

std::string svg(const Label& s) {
    const char* const anchors[] = {"start", "middle", "end"};
    return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" fill="{}">{}</text>)", s.x,
                       s.y, anchors[static_cast<int>(s.anchor)], hex(s.colour), escaped(s.text));
}

}  // namespace

std::string svg_text(const Drawing& drawing) {
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        drawing.width, drawing.height);
    for (const auto& shape : drawing.shapes) {
        text += std::visit([](const auto& s) { return svg(s); }, shape) + "\n";
    }
    return text + "</svg>\n";
}

}  // namespace sonarsim
