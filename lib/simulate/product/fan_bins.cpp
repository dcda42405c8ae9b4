#include "simulate/product/fan_bins.h"

namespace sonarsim {

namespace {

/// The bin of a place; -1 outside the sector.
std::int32_t bin_at(const View& view, const ColumnFinder& column_at, const FanPlace& place) {
    if (!is_inside_sector(view, place)) return -1;
    const double bins = (place.range_m - view.range_min_m) / view.bin_m();
    const double beams = column_at(place.azimuth_rad);
    // A point on the last edge, exactly or by rounding, belongs to the bin before it.
    const int i = std::clamp(static_cast<int>(bins), 0, view.range_bins - 1);
    const int j = std::clamp(static_cast<int>(beams), 0, view.beams - 1);
    return j * view.range_bins + i;
}

}  // namespace

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
