#include "scene/images/image_place.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// The pixels from `low` to `high`, with a margin, of `count` that begin at `start`; all of them if
/// fewer than two would remain.
std::array<int, 2> pixels_between(double low, double high, double start, double step, int count) {
    constexpr double margin = 2.0;
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    const double first = std::max(std::floor(std::min(a, b)) - margin, 0.0);
    const double last = std::min(std::ceil(std::max(a, b)) + margin, static_cast<double>(count));
    if (!(last - first >= 2.0)) return {0, count};
    return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

PixelGrid grid_in_metres(const Image& image, double pixel_m, const std::array<double, 2>& size_m,
                         const std::string& section, const Location& where) {
    std::array<double, 2> pixel{pixel_m, pixel_m};
    if (size_m[0] > 0.0) pixel = {size_m[0] / image.width, size_m[1] / image.height};
    if (pixel[0] > 0.0)
        return {0.5 * pixel[0], (image.height - 0.5) * pixel[1], pixel[0], -pixel[1]};
    if (!image.grid) {
        throw InputError(where,
                         "does not say how large its pixels are: it has no GeoTIFF tags, "
                         "and no world file lies next to it; write " +
                             section + ".pixel_m or size_m");
    }
    if (image.in_degrees) {
        throw InputError(where,
                         "has its pixels in degrees; make a map in metres of it, as with "
                         "gdalwarp -t_srs EPSG:32632");
    }
    return *image.grid;
}

PixelWindow pixels_within(const Image& image, const PixelGrid& grid,
                          const Eigen::AlignedBox2d& box_m) {
    const auto rows =
        pixels_between(box_m.min().y(), box_m.max().y(), grid.y_m, grid.row_m, image.height);
    const auto columns =
        pixels_between(box_m.min().x(), box_m.max().x(), grid.x_m, grid.column_m, image.width);
    return {rows[0], rows[1], columns[0], columns[1]};
}

}  // namespace sonarsim
