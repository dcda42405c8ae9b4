#include "core/elementary.h"
#include "core/ordered_pipeline.h"
#include "core/text.h"
#include "core/units.h"
#include "run/preview/preview.h"
#include "simulate/product/contrast.h"
#include "simulate/product/fan.h"
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

Eigen::Vector2i pixel_of(const FanFrame& frame, const View& view, double range_m,
                         double azimuth_rad) {
    const SinCos at = sincos(azimuth_rad);
    return Eigen::Array2d(0.5 * frame.width - range_m * at.sin / frame.pixel_m,
                          (view.range_max_m - range_m * at.cos) / frame.pixel_m)
        .floor()
        .cast<int>();
}

/// Writes a number within the picture.
void write_number(Picture& picture, const Eigen::Vector2i& at, const std::string& text) {
    const int half = text_width(text) / 2 + 1;
    const int x = std::clamp(at.x(), half, std::max(half, picture.width - half));
    const int y = std::clamp(at.y(), 5, std::max(5, picture.height - 5));
    outlined_label(picture, x, y, text, Align::middle, mark_colour);
}

void write_numbers(Picture& picture, const FanFrame& frame, const View& view) {
    const bool wide = view.azimuth_rad > pi;
    for (const double range_m : ring_ranges(view)) {
        if (range_m > 0.97 * view.range_max_m) continue;  // the outermost bearing has its number
        const std::string text = number_text(range_m) + " m";
        Eigen::Vector2i at = pixel_of(frame, view, range_m, wide ? 0.0 : -0.5 * view.azimuth_rad);
        at += Eigen::Vector2i(5 + text_width(text) / 2, wide ? 6 : 2);
        write_number(picture, at, text);
    }
    const double in_m = 14.0 * frame.pixel_m;
    for (const double bearing : bearings_deg(view)) {
        const char* side = bearing > 0.0 && bearing < 180.0 ? "P" : bearing < 0.0 ? "S" : "";
        write_number(picture, pixel_of(frame, view, view.range_max_m - in_m, radians(bearing)),
                     number_text(std::fabs(bearing)) + side);
    }
}

/// The grey values of render_fan() in amber, with rings and bearings. Numbers where there is room:
/// ranges along the starboard edge, or the boresight of a view wider than 180 degrees; bearings in
/// degrees below the largest range, "P" for port and "S" for starboard.
Picture styled_fan(const Sonar& sonar, const FanFrame& frame, std::span<const std::uint8_t> grey) {
    Picture picture(frame.width, frame.height, backdrop);
    for (std::size_t k = 0; k < grey.size(); ++k)
        picture.pixels[k] = blend(amber_colours, static_cast<float>(grey[k]) / 255.0F);
    const View& view = sonar.settings.view;
    draw_lines(picture, frame, view);
    if (std::min(frame.width, frame.height) >= min_px) write_numbers(picture, frame, view);
    return picture;
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

/// The records of the pings around a ping, and its index among them.
struct Series {
    std::vector<std::vector<float>> records;
    std::size_t here;
    double white;
};

/// Draws records as rows or columns (`upright`); a pixel is the mean of the values that it covers.
void draw_values(Picture& picture, int left, int width, int height, const Series& series,
                 bool upright, std::span<const Rgb> stops) {
    const std::vector<std::vector<float>>& records = series.records;
    const std::size_t all_rows = upright ? records[0].size() : records.size();
    const std::size_t all_columns = upright ? records.size() : records[0].size();
    const auto span_of = [](int pixel, int pixels, std::size_t count) {
        const std::size_t begin = static_cast<std::size_t>(pixel) * count / pixels;
        const std::size_t end = (static_cast<std::size_t>(pixel) + 1) * count / pixels;
        return std::pair(begin, std::max(end, begin + 1));
    };
    for (int y = 0; y < height; ++y) {
        const auto rows = span_of(y, height, all_rows);
        for (int x = 0; x < width; ++x) {
            const auto columns = span_of(x, width, all_columns);
            float sum = 0.0F;
            for (std::size_t i = rows.first; i < rows.second; ++i) {
                for (std::size_t j = columns.first; j < columns.second; ++j)
                    sum += upright ? records[j][i] : records[i][j];
            }
            const auto count =
                static_cast<float>((rows.second - rows.first) * (columns.second - columns.first));
            picture.row(y)[left + x] =
                blend(stops, shade(sum / count, static_cast<float>(series.white)));
        }
    }
}

Series render_series(const Sonar& sonar, const RecordShape& shape, std::uint32_t pose,
                     std::size_t poses, const RenderPing& render) {
    const auto every = static_cast<std::size_t>(sonar.config.every);
    const std::size_t all = (poses + every - 1) / every;
    const std::size_t count = std::min(all, series_pings);
    const std::size_t here = pose / every;
    const std::size_t first = std::min(here - std::min(here, count / 2), all - count);
    const auto last = static_cast<std::uint32_t>((first + count - 1) * every);
    Series series{{}, here - first, 1.0};
    Gain gain;
    for (const Ping& ping : render_all(poses_until(sonar, last, count), render)) {
        gain.add(ping.intensity);
        series.records.push_back(record_values(shape, sonar.config, ping.intensity, 0.0F));
    }
    series.white = gain.white();
    return series;
}

/// Draws pings as rows, with the range axis below.
SonarPanel draw_rows(const Sonar& sonar, const RecordShape& shape, const Series& series, int width,
                     int height) {
    const SonarConfig& config = sonar.config;
    Picture picture(width, height, backdrop);
    const int bottom = height - axis_px;
    draw_values(picture, 0, width, bottom, series, false, copper_colours);
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
    const int y = static_cast<int>((series.here + 0.5) * bottom / series.records.size());
    fill(picture, 0, y, 14, 1, mark_colour);
    fill(picture, width - 14, y, 14, 1, mark_colour);
    return {std::move(picture), series.white};
}

/// Draws pings as columns, with the range axis on the left.
SonarPanel draw_columns(const Sonar& sonar, const Series& series, int width, int height) {
    const SonarConfig& config = sonar.config;
    Picture picture(width, height, backdrop);
    const int left = number_px;
    draw_values(picture, left, width - left, height, series, true, sea_colours);
    const double px_per_m = height / (config.range_max_m - config.range_min_m);
    for (const double range : axis_marks(config.range_min_m, config.range_max_m, 8.0)) {
        const int y = static_cast<int>((range - config.range_min_m) * px_per_m);
        fill(picture, left - 5, y, 5, 1, ink);
        label(picture, left - 8, std::clamp(y, 6, height - 6), number_text(range) + " m",
              Align::right);
    }
    const int x =
        left + static_cast<int>((series.here + 0.5) * (width - left) / series.records.size());
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
    const Series series = render_series(sonar, shape, own, poses, render);
    return shape.upright ? draw_columns(sonar, series, width, height)
                         : draw_rows(sonar, shape, series, width, height);
}

}  // namespace sonarsim
