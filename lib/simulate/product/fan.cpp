#include "simulate/product/fan.h"

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// Bins in range or in azimuth that a pixel averages; only pixels next to the apex cover more.
constexpr double max_bins = 128.0;

/// The ratio of the beams that a pixel covers in successive rings.
constexpr double ring_step = 1.125;

/// Number of points that sample the share of a pixel inside the sector.
constexpr int cover_points = 64;

/// The number of a pixel's points, a rank-1 lattice, inside the sector.
int covered_points(const View& view, const FanFrame& frame, int column, int row) {
    constexpr int count = cover_points;
    constexpr int step = 19;
    int inside = 0;
    for (int k = 0; k < count; ++k) {
        const double right = (k + 0.5) / count - 0.5;
        const double down = (k * step % count + 0.5) / count - 0.5;
        inside +=
            is_inside_sector(view, fan_place(frame, view.range_max_m, column + right, row + down));
    }
    return inside;
}

bool is_near_edge(const View& view, const FanFrame& frame, const FanPlace& place) {
    const double aside = std::fabs(0.5 * view.azimuth_rad - std::fabs(place.azimuth_rad));
    const bool full_turn = view.azimuth_rad >= 2.0 * pi;
    return std::fabs(place.range_m - view.range_min_m) < frame.pixel_m ||
           std::fabs(place.range_m - view.range_max_m) < frame.pixel_m ||
           (!full_turn && place.range_m * std::min(aside, 1.0) < frame.pixel_m);
}

/// The number of columns at each end of a row that are clearly outside the sector.
int first_column(const View& view, const FanFrame& frame, int row) {
    if (view.azimuth_rad >= pi) return 0;
    const SinCos half = sincos(0.5 * view.azimuth_rad);
    const double x = view.range_max_m - (row + 0.5) * frame.pixel_m;
    constexpr double margin_px = 2.0;
    const double max_px = (x / frame.pixel_m * half.sin + margin_px) / half.cos;
    const double columns = std::floor(0.5 * frame.width - 0.5 - max_px);
    return static_cast<int>(std::clamp(columns, 0.0, 0.5 * frame.width));
}

/// The places of the pixels of a row from `first` on. The right half mirrors the left.
std::vector<FanPlace> places_of_row(const View& view, const FanFrame& frame, int first, int row) {
    std::vector<FanPlace> places(static_cast<std::size_t>(frame.width - 2 * first));
    for (std::size_t k = 0; 2 * k < places.size(); ++k) {
        const FanPlace left =
            fan_place(frame, view.range_max_m, static_cast<double>(k) + first, row);
        places[places.size() - 1 - k] = {left.x_m, -left.y_m, left.range_m, -left.azimuth_rad};
        places[k] = left;
    }
    return places;
}

/// The range bins from the nearest range to a place.
double bins_to(const View& view, const FanPlace& place) {
    return (place.range_m - view.range_min_m) / view.bin_m();
}

/// The number of bins that a pixel `extent` bins wide has the mean of.
int bins_of(double extent) {
    return std::max(1, static_cast<int>(std::lround(extent)));
}

/// The ring of pixels that are `extent` beams wide; ring 0 holds those of up to one beam.
std::size_t ring_of(double extent) {
    std::size_t ring = 0;
    double limit = 1.0;
    while (limit < std::min(extent, max_bins)) {
        limit *= ring_step;
        ++ring;
    }
    return ring;
}

/// The first of the `count` bins nearest to a place, in bins from the lower edge of bin 0.
int first_of_nearest(double place, int count) {
    // With one bin it is the bin of the place.
    return static_cast<int>(std::floor(place - 0.5 * (count - 1)));
}

/// Adds a pixel to a ring. Pixels are added in the order of the picture.
void add_pixel(FanMap::Ring& ring, std::int32_t first_bin, int index, int covered) {
    if (covered < cover_points) {
        ring.edges.push_back({static_cast<std::uint32_t>(ring.pixels.size()),
                              static_cast<float>(covered) / cover_points});
    }
    ring.pixels.push_back(first_bin);
    const bool goes_on =
        !ring.runs.empty() && ring.runs.back().index + ring.runs.back().count == index;
    goes_on ? void(++ring.runs.back().count) : ring.runs.push_back({index, 1});
}

/// The bin of a place; -1 outside the sector.
std::int32_t bin_at(const View& view, const ColumnFinder& column_at, const FanPlace& place) {
    if (!is_inside_sector(view, place)) return -1;
    // A point on the last edge, exactly or by rounding, belongs to the bin before it.
    const int i = std::clamp(static_cast<int>(bins_to(view, place)), 0, view.range_bins - 1);
    const int j = std::clamp(static_cast<int>(column_at(place.azimuth_rad)), 0, view.beams - 1);
    return j * view.range_bins + i;
}

}  // namespace

FanPlace fan_place(const FanFrame& frame, double range_max_m, double column, double row) {
    const double x = range_max_m - (row + 0.5) * frame.pixel_m;
    const double y = (0.5 * frame.width - (column + 0.5)) * frame.pixel_m;
    return {x, y, std::sqrt(x * x + y * y), arctan2(y, x)};
}

bool is_inside_sector(const View& view, const FanPlace& place) {
    return place.range_m >= view.range_min_m && place.range_m < view.range_max_m &&
           std::fabs(place.azimuth_rad) <= 0.5 * view.azimuth_rad;
}

FanFrame fan_frame(const Sonar& sonar, int width_px) {
    const View& view = sonar.settings.view;
    const SinCos half = sincos(0.5 * view.azimuth_rad);
    const bool wide = view.azimuth_rad > pi;
    const double width_m = 2.0 * view.range_max_m * (wide ? 1.0 : half.sin);
    const double height_m = view.range_max_m * (wide ? 1.0 - half.cos : 1.0);
    const double framed_m = std::max(width_m, 0.5 * height_m);
    FanFrame frame;
    frame.width =
        width_px > 0
            ? width_px
            : static_cast<int>(std::clamp(std::ceil(framed_m / view.bin_m()), 1.0, 1024.0));
    frame.pixel_m = framed_m / frame.width;
    frame.height = static_cast<int>(std::ceil(height_m / frame.pixel_m - 1e-6));
    return frame;
}

FanMap make_fan_map(const Sonar& sonar, int width_px) {
    const View& view = sonar.settings.view;
    FanMap map;
    map.frame = fan_frame(sonar, width_px);
    map.full_turn = view.azimuth_rad >= 2.0 * pi;
    map.range_bins = bins_of(std::min(map.frame.pixel_m / view.bin_m(), max_bins));
    map.range_padding = map.range_bins / 2 + 1;
    const double beams_per_rad = view.beams / view.azimuth_rad;
    const auto beams_across = [&](double range_m) {
        return std::min({map.frame.pixel_m * beams_per_rad / range_m, max_bins,
                         static_cast<double>(view.beams)});
    };
    const ColumnFinder column_at(sonar);
    const double nearest_m = std::max(view.range_min_m - map.frame.pixel_m, 0.0);
    double extent = 1.0;
    for (std::size_t k = 0; k <= ring_of(beams_across(nearest_m)); ++k, extent *= ring_step)
        map.rings.push_back({bins_of(extent), {}, {}, {}});
    map.beam_padding = map.rings.back().beams / 2 + 1;
    const int width = view.beams + 2 * map.beam_padding;
    for (int row = 0; row < map.frame.height; ++row) {
        const int first = first_column(view, map.frame, row);
        int column = first - 1;
        for (const FanPlace& place : places_of_row(view, map.frame, first, row)) {
            ++column;
            const int covered = is_near_edge(view, map.frame, place)
                                    ? covered_points(view, map.frame, column, row)
                                    : (is_inside_sector(view, place) ? cover_points : 0);
            if (covered == 0) continue;
            // The centre of a pixel on the edge may lie outside the sector.
            const double bins = std::clamp(bins_to(view, place), 0.0, view.range_bins - 1e-6);
            const double beams =
                std::clamp(double{column_at(place.azimuth_rad)}, 0.0, view.beams - 1e-6);
            FanMap::Ring& ring = map.rings[ring_of(beams_across(place.range_m))];
            const int first_row = first_of_nearest(bins, map.range_bins) + map.range_padding;
            const int first_beam = first_of_nearest(beams, ring.beams) + map.beam_padding;
            add_pixel(ring, first_row * width + first_beam, row * map.frame.width + column,
                      covered);
        }
    }
    return map;
}

FanBins make_fan_bins(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const ColumnFinder column_at(sonar);
    FanBins fan;
    fan.frame = fan_frame(sonar);
    const auto width = static_cast<std::size_t>(fan.frame.width);
    const auto height = static_cast<std::size_t>(fan.frame.height);
    fan.by_row.resize(width * height);
    fan.by_column.resize(width * height);
    fan.boxes.resize(static_cast<std::size_t>(view.beams) * view.range_bins);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const std::int32_t bin =
                bin_at(view, column_at,
                       fan_place(fan.frame, view.range_max_m, static_cast<double>(column),
                                 static_cast<double>(row)));
            fan.by_row[row * width + column] = bin;
            fan.by_column[column * height + row] = bin;
            if (bin < 0) continue;
            PixelBox& box = fan.boxes[static_cast<std::size_t>(bin)];
            const auto x = static_cast<int>(column);
            const auto y = static_cast<int>(row);
            box = joined(box, {x, x + 1, y, y + 1});
        }
    }
    return fan;
}

}  // namespace sonarsim
