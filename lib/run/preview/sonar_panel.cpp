#include "run/preview/sonar_panel.h"

#include <algorithm>
#include <cmath>

#include "core/ordered_pipeline.h"
#include "core/text.h"
#include "run/preview/drawing.h"
#include "run/preview/fan_style.h"
#include "simulate/product/contrast.h"
#include "simulate/product/scan.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

constexpr std::size_t series_pings = 120;  // pings of a waterfall or an echogram
constexpr int axis_px = 20;                // height of the axis below a waterfall
constexpr int number_px = 52;              // width of the numbers next to an echogram

/// The poses of `count` pings of a sonar up to `last`; fewer at the start of the trajectory.
std::vector<std::uint32_t> poses_until(const Sonar& sonar, std::uint32_t last, std::size_t count) {
    const auto every = static_cast<std::uint32_t>(sonar.config.every);
    std::vector<std::uint32_t> poses;
    for (std::uint32_t ping = last / every; poses.size() < count; --ping) {
        poses.push_back(ping * every);
        if (ping == 0) break;
    }
    std::ranges::reverse(poses);
    return poses;
}

std::vector<Ping> render_all(const std::vector<std::uint32_t>& poses, const RenderPing& render) {
    std::vector<Ping> pings(poses.size());
    in_parallel(poses.size(), [&](std::size_t k) { pings[k] = render(poses[k]); });
    return pings;
}

/// Draws the largest fan that fits.
SonarPanel draw_fan(const Sonar& sonar, const Ping& ping, int width, int height) {
    const FanFrame full = fan_frame(sonar, width);
    const int fits = full.height <= height
                         ? width
                         : std::max(1, static_cast<int>(std::floor(static_cast<double>(width) *
                                                                   height / full.height)) -
                                           1);
    const FanMap map = make_fan_map(sonar, fits);
    Gain gain;
    gain.add(ping.intensity);
    return {styled_fan(sonar, map.frame, render_fan(map, ping, gain.white())), gain.white()};
}

SonarPanel draw_scan(const Sonar& sonar, std::uint32_t pose, const RenderPing& render, int width,
                     int height) {
    const auto steps = static_cast<std::size_t>(scan_steps(sonar.config));
    const std::vector<std::uint32_t> poses = poses_until(sonar, pose, steps);
    const std::vector<Ping> pings = render_all(poses, render);
    ScanDisplay display(sonar);
    for (std::size_t k = 0; k < poses.size(); ++k)
        display.show(poses[k] / static_cast<std::uint32_t>(sonar.config.every), pings[k].intensity);
    return draw_fan(whole_scan(sonar), display.image(), width, height);
}

/// The values of a picture, [rows, columns].
struct Values {
    std::size_t rows;
    std::size_t columns;
    std::vector<float> value;
};

/// Draws values; a pixel shows the mean of the values that it covers, at least one.
void draw_values(Picture& picture, int left, int width, int height, const Values& values,
                 double white, std::span<const Rgb> stops) {
    const auto span_of = [](int pixel, int pixels, std::size_t count) {
        const std::size_t begin = static_cast<std::size_t>(pixel) * count / pixels;
        const std::size_t end = (static_cast<std::size_t>(pixel) + 1) * count / pixels;
        return std::pair(begin, std::max(end, begin + 1));
    };
    for (int y = 0; y < height; ++y) {
        const auto rows = span_of(y, height, values.rows);
        for (int x = 0; x < width; ++x) {
            const auto columns = span_of(x, width, values.columns);
            float sum = 0.0F;
            for (std::size_t i = rows.first; i < rows.second; ++i) {
                for (std::size_t j = columns.first; j < columns.second; ++j)
                    sum += values.value[i * values.columns + j];
            }
            const auto count =
                static_cast<float>((rows.second - rows.first) * (columns.second - columns.first));
            picture.row(y)[left + x] = blend(stops, shade(sum / count, static_cast<float>(white)));
        }
    }
}

/// The pings around a ping, and its index among them.
struct Series {
    std::vector<Ping> pings;
    std::size_t here;
    double white;
};

Series render_series(const Sonar& sonar, std::uint32_t pose, std::size_t poses,
                     const RenderPing& render) {
    const auto every = static_cast<std::size_t>(sonar.config.every);
    const std::size_t all = (poses + every - 1) / every;
    const std::size_t count = std::min(all, series_pings);
    const std::size_t here = pose / every;
    const std::size_t first = std::min(here - std::min(here, count / 2), all - count);
    const auto last = static_cast<std::uint32_t>((first + count - 1) * every);
    Series series{render_all(poses_until(sonar, last, count), render), here - first, 1.0};
    Gain gain;
    for (const Ping& ping : series.pings)
        gain.add(ping.intensity);
    series.white = gain.white();
    return series;
}

/// Draws pings as rows, with the range axis below.
SonarPanel draw_rows(const Sonar& sonar, const RecordShape& shape, const Series& series, int width,
                     int height) {
    const SonarConfig& config = sonar.config;
    Values values{series.pings.size(), shape.values(config), {}};
    for (const Ping& ping : series.pings) {
        const std::vector<float> row = record_values(shape, config, ping.intensity, 0.0F);
        values.value.insert(values.value.end(), row.begin(), row.end());
    }
    Picture picture(width, height, backdrop);
    const int bottom = height - axis_px;
    draw_values(picture, 0, width, bottom, values, series.white, copper_colours);
    const auto mark_at = [&](double range, int x) {
        fill(picture, x, bottom, 1, 4, ink);
        const std::string text = number_text(range) + " m";
        const int half = text_width(text) / 2 + 1;
        if (x >= half && x + half < width) label(picture, x, bottom + 12, text, Align::middle);
    };
    if (shape.two_sides) {
        const double px_per_m = 0.5 * width / config.range_max_m;
        mark_at(0.0, width / 2);
        for (const double range : axis_marks(0.0, config.range_max_m, 5.0)) {
            if (range == 0.0) continue;
            for (const double side : {-1.0, 1.0})
                mark_at(range, static_cast<int>(0.5 * width + side * range * px_per_m));
        }
        outlined_label(picture, 18, 10, "port", Align::left, mark_colour);
        outlined_label(picture, width - 18, 10, "starboard", Align::right, mark_colour);
    } else {
        const double px_per_m = width / (config.range_max_m - config.range_min_m);
        for (const double range : axis_marks(config.range_min_m, config.range_max_m, 8.0))
            mark_at(range, static_cast<int>((range - config.range_min_m) * px_per_m));
    }
    const int y = static_cast<int>((series.here + 0.5) * bottom / series.pings.size());
    fill(picture, 0, y, 14, 1, mark_colour);
    fill(picture, width - 14, y, 14, 1, mark_colour);
    return {std::move(picture), series.white};
}

/// Draws pings as columns, with the range axis on the left.
SonarPanel draw_columns(const Sonar& sonar, const RecordShape& shape, const Series& series,
                        int width, int height) {
    const SonarConfig& config = sonar.config;
    const std::size_t columns = series.pings.size();
    Values values{shape.values(config), columns, {}};
    values.value.resize(values.rows * columns);
    for (std::size_t k = 0; k < columns; ++k) {
        const std::vector<float> column =
            record_values(shape, config, series.pings[k].intensity, 0.0F);
        for (std::size_t i = 0; i < column.size(); ++i)
            values.value[i * columns + k] = column[i];
    }
    Picture picture(width, height, backdrop);
    const int left = number_px;
    draw_values(picture, left, width - left, height, values, series.white, sea_colours);
    const double px_per_m = height / (config.range_max_m - config.range_min_m);
    for (const double range : axis_marks(config.range_min_m, config.range_max_m, 8.0)) {
        const int y = static_cast<int>((range - config.range_min_m) * px_per_m);
        fill(picture, left - 5, y, 5, 1, ink);
        label(picture, left - 8, std::clamp(y, 6, height - 6), number_text(range) + " m",
              Align::right);
    }
    const int x = left + static_cast<int>((series.here + 0.5) * (width - left) / columns);
    fill(picture, x, 0, 1, 14, mark_colour);
    fill(picture, x, height - 14, 1, 14, mark_colour);
    return {std::move(picture), series.white};
}

}  // namespace

std::uint32_t ping_at(const Sonar& sonar, std::uint32_t pose) {
    return pose - pose % static_cast<std::uint32_t>(sonar.config.every);
}

SonarPanel draw_sonar(const Sonar& sonar, std::uint32_t pose, std::size_t poses,
                      const RenderPing& render, int width, int height) {
    const std::uint32_t own = ping_at(sonar, pose);
    const RecordShape& shape = kind_of(sonar.config.kind).record;
    if (shape.pictures == RecordPictures::none) return draw_fan(sonar, render(own), width, height);
    if (shape.pictures == RecordPictures::sweeps)
        return draw_scan(sonar, own, render, width, height);
    const Series series = render_series(sonar, own, poses, render);
    return shape.upright ? draw_columns(sonar, shape, series, width, height)
                         : draw_rows(sonar, shape, series, width, height);
}

}  // namespace sonarsim
