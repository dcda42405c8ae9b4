#include <doctest/doctest.h>

#include <algorithm>

#include "benchmark/report_plot.h"

using namespace sonarsim;

namespace {

Plot small_plot() {
    return {"a < b & c",
            "ms per ping",
            "relative L1",
            {{"rays", {31, 119, 180}, {{1.0, 0.1, "0.1"}, {10.0, 0.01, "0.01", true}}, true},
             {"none", {0, 0, 0}, {{0.0, 0.1, "left out"}}}}};
}

/// Whether every tag is closed and every attribute quoted; enough XML for what is written here.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (tag.find('<') != std::string::npos || std::ranges::count(tag, '"') % 2) return false;
        const std::string name = tag.substr(0, tag.find(' '));
        if (name[0] == '/') {
            if (open.empty() || open.back() != name.substr(1)) return false;
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
    }
    return open.empty();
}

}  // namespace

TEST_SUITE_BEGIN("benchmark");

TEST_CASE("a plot is well-formed SVG with every point that has a place") {
    const std::string svg = svg_text(draw_log_log(small_plot()));
    CHECK(is_well_formed(svg));
    CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
    CHECK(svg.find(">0.01</text>") != std::string::npos);
    CHECK(svg.find("left out") == std::string::npos);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("points lie where their logarithms say") {
    const Drawing drawing = draw_log_log(small_plot());
    std::vector<Disc> dots;
    for (const auto& shape : drawing.shapes) {
        const Disc* const disc = std::get_if<Disc>(&shape);
        if (disc != nullptr && disc->ring == 0.0) dots.push_back(*disc);
    }
    REQUIRE(dots.size() == 2);
    CHECK(dots[0].x < dots[1].x);  // slower is to the right
    CHECK(dots[0].y < dots[1].y);  // a smaller error is lower
}

TEST_CASE("a plot of nothing is a plot") {
    CHECK(is_well_formed(svg_text(draw_log_log({"", "x", "y", {}}))));
}

TEST_CASE("shapes become pixels") {
    constexpr Colour red{255, 0, 0};
    const Drawing drawing{
        30,
        20,
        {Disc{10.0, 10.0, 4.0, 0.0, red}, Line{20.0, 0.0, 20.0, 20.0, 2.0, {0, 0, 255}},
         Label{23.0, 12.0, "i", Anchor::start, {0, 0, 0}}}};
    const std::vector<std::uint8_t> pixels = raster(drawing);
    REQUIRE(pixels.size() == 30 * 20 * 3);
    const auto at = [&](int x, int y) {
        const std::uint8_t* const p = pixels.data() + 3 * (y * 30 + x);
        return Colour{p[0], p[1], p[2]};
    };
    CHECK(at(10, 10) == red);
    CHECK(at(1, 1) == Colour{255, 255, 255});
    CHECK(at(20, 5) == Colour{0, 0, 255});
    // The capital I: a bar over its whole height in the third of five columns.
    CHECK(at(25, 8) == Colour{0, 0, 0});
    CHECK(at(24, 8) == Colour{255, 255, 255});
}

TEST_SUITE_END();
