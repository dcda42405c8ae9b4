#include <spdlog/fmt/fmt.h>

#include <cctype>
#include <cmath>
#include <utility>

#include "run/preview/preview.h"

namespace sonarsim {

namespace {

constexpr int min_left_margin = 56;
constexpr int bottom_margin = 20;

/// The part of the line from + t way, t in [0, 1], that lies within a rectangle of this size at the
/// origin, by its first and last t (Liang and Barsky); nothing if no part does.
std::optional<std::pair<double, double>> part_within(const Eigen::Vector2d& size,
                                                     const Eigen::Vector2d& from,
                                                     const Eigen::Vector2d& way) {
    double begin = 0.0;
    double end = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0.0) {
            if (from[axis] < 0.0 || from[axis] >= size[axis]) return std::nullopt;
            continue;
        }
        const double a = -from[axis] / way[axis];
        const double b = (size[axis] - from[axis]) / way[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(begin <= end)) return std::nullopt;
    return std::pair(begin, end);
}

}  // namespace

void tint(Picture& picture, int x, int y, Rgb colour, float share) {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
    Rgb& pixel = picture.row(y)[x];
    const Rgb ends[] = {pixel, colour};
    pixel = blend(ends, share);
}

void draw_line(Picture& picture, Eigen::Vector2d from, Eigen::Vector2d to, Rgb colour,
               float share) {
    // Clipping the line first keeps the number of steps small.
    const Eigen::Vector2d way = to - from;
    const auto part = part_within({picture.width, picture.height}, from, way);
    if (!part) return;
    to = from + part->second * way;
    from += part->first * way;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).lpNorm<1>())));
    int last_x = -1;
    int last_y = -1;
    for (int k = 0; k <= steps; ++k) {
        const Eigen::Vector2d at = from + (to - from) * (static_cast<double>(k) / steps);
        const int x = static_cast<int>(std::floor(at.x()));
        const int y = static_cast<int>(std::floor(at.y()));
        if (x == last_x && y == last_y) continue;
        tint(picture, x, y, colour, share);
        last_x = x;
        last_y = y;
    }
}

void draw_dot(Picture& picture, const Eigen::Vector2d& at, int half, Rgb colour) {
    const double limit = picture.width + picture.height;
    if (!(at.cwiseAbs().maxCoeff() < limit)) return;
    fill(picture, static_cast<int>(std::floor(at.x())) - half,
         static_cast<int>(std::floor(at.y())) - half, 2 * half + 1, 2 * half + 1, colour);
}

void label(Picture& picture, int x, int y, std::string text, Align align, Rgb colour) {
    constexpr int half_height = 3;
    const auto is_letter = [&](std::size_t k) {
        return k < text.size() &&
               (text[k] == '_' || std::isalpha(static_cast<unsigned char>(text[k])));
    };
    // A small m is the sign of metres; within words it is a capital.
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == 'm' && (is_letter(k + 1) || (k > 0 && is_letter(k - 1)))) text[k] = 'M';
    }
    write(picture, x, y - half_height, text, align, colour);
}

void outlined_label(Picture& picture, int x, int y, const std::string& text, Align align,
                    Rgb colour) {
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i)
            label(picture, x + i, y + j, text, align, backdrop);
    }
    label(picture, x, y, text, align, colour);
}

void paste(Picture& picture, const Picture& part, int x, int y) {
    for (int row = 0; row < part.height; ++row) {
        const auto from = part.pixels.begin() + static_cast<std::ptrdiff_t>(row) * part.width;
        std::copy_n(from, part.width, picture.row(y + row) + x);
    }
}

Eigen::Vector2d PlaneFrame::pixel(const Eigen::Vector2d& at_m) const {
    return {left + (at_m.x() - low.x()) / pixel_m, plot_height - (at_m.y() - low.y()) / pixel_m};
}

Eigen::Vector2d PlaneFrame::metres(int column, int row) const {
    return {low.x() + (column + 0.5) * pixel_m, low.y() + (plot_height - row - 0.5) * pixel_m};
}

PlaneFrame plane_frame(int width, int height, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high) {
    PlaneFrame frame;
    // The margin holds the longest number of the vertical axis.
    const double furthest = std::max(std::fabs(low.y()), std::fabs(high.y()));
    const std::string longest = "-" + std::to_string(std::llround(furthest)) + ".5 m";
    frame.left = std::max(min_left_margin, text_width(longest) + 12);
    frame.plot_width = width - frame.left - 1;
    frame.plot_height = height - bottom_margin;
    const Eigen::Vector2d plot(frame.plot_width, frame.plot_height);
    frame.pixel_m = (high - low).cwiseMax(1e-3).cwiseQuotient(plot).maxCoeff();
    frame.low = 0.5 * (low + high) - 0.5 * (frame.pixel_m * plot);
    return frame;
}

void draw_axes(Picture& tile, const PlaneFrame& frame) {
    const int bottom = frame.plot_height;
    fill(tile, 0, 0, frame.left, tile.height, backdrop);
    fill(tile, 0, bottom, tile.width, tile.height - bottom, backdrop);
    const int right = frame.left + frame.plot_width;
    fill(tile, right, 0, tile.width - right, tile.height, backdrop);
    fill(tile, frame.left - 1, 0, 1, bottom, ink);
    fill(tile, frame.left - 1, bottom, frame.plot_width + 1, 1, ink);
    const Eigen::Vector2d high =
        frame.low + frame.pixel_m * Eigen::Vector2d(frame.plot_width, frame.plot_height);
    int last = 0;  // end of the number before
    for (const double x : axis_marks(frame.low.x(), high.x(), 6.0)) {
        const int at = static_cast<int>(frame.pixel({x, frame.low.y()}).x());
        fill(tile, at, bottom, 1, 4, ink);
        const std::string number = fmt::format("{:.12g} m", x);
        const int half = text_width(number) / 2;
        constexpr int blank_px = 6;
        if (at - half <= last || at + half >= tile.width) continue;
        label(tile, at, bottom + 12, number, Align::middle);
        last = at + half + blank_px;
    }
    for (const double y : axis_marks(frame.low.y(), high.y(), 5.0)) {
        const int at = static_cast<int>(frame.pixel({frame.low.x(), y}).y());
        fill(tile, frame.left - 5, at, 4, 1, ink);
        label(tile, frame.left - 8, std::clamp(at, 6, tile.height - 6), fmt::format("{:.12g} m", y),
              Align::right);
    }
}

}  // namespace sonarsim
