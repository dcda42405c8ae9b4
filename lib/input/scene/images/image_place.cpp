#include "input/scene/images/image_place.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <system_error>

#include "core/file.h"
#include "core/text.h"

namespace sonarsim {

namespace {

/// The world file next to an image; empty if there is none. For ".tif" its extension is ".tfw",
/// ".tifw" or ".wld", in lower case or capitals.
std::filesystem::path find_world_file(const std::filesystem::path& image) {
    const std::string extension = image.extension().string();
    std::string brief = "." + extension.substr(extension.size() < 2 ? 0 : 1, 1);
    if (!extension.empty()) brief += extension.back();
    std::error_code ignored;
    for (const std::string& end : {brief + "w", extension + "w", std::string(".wld")}) {
        for (const std::string& name : {end, in_capitals(end)}) {
            std::filesystem::path file = image;
            file.replace_extension(name);
            if (std::filesystem::is_regular_file(file, ignored)) return file;
        }
    }
    return {};
}

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

std::optional<PixelGrid> read_world_file(const std::filesystem::path& image) {
    const std::filesystem::path file = find_world_file(image);
    if (file.empty()) return std::nullopt;
    const Location where{file.string()};
    std::istringstream words(read_file(file, 10'000));
    std::array<double, 6> numbers{};
    for (double& number : numbers) {
        std::string word;
        words >> word;
        const auto value = parse_number(word);
        if (!value)
            refuse(where,
                   "is not a world file, which has six numbers: the width of a pixel, 0, 0, its "
                   "negative height, and x and y of the first pixel's centre");
        number = *value;
    }
    if (numbers[1] != 0.0 || numbers[2] != 0.0) {
        refuse(where,
               "its rows and columns do not run along east and north; make a map of it whose first "
               "row is the north, as with gdalwarp");
    }
    return PixelGrid{numbers[4], numbers[5], numbers[0], numbers[3]};
}

PixelGrid grid_in_metres(const Image& image, double pixel_m, const std::string& section,
                         const Location& where) {
    if (pixel_m > 0.0) return {0.5 * pixel_m, (image.height - 0.5) * pixel_m, pixel_m, -pixel_m};
    if (!image.grid) {
        refuse(where,
               "does not say how large its pixels are: it has no GeoTIFF tags, and no world file "
               "lies next to it; write {}.pixel_m",
               section);
    }
    if (image.in_degrees) {
        refuse(where,
               "has its pixels in degrees; make a map in metres of it, as with gdalwarp -t_srs "
               "EPSG:32632");
    }
    return *image.grid;
}

PixelWindow pixels_within(const Image& image, const PixelGrid& grid,
                          const Eigen::AlignedBox2d& box_m, std::size_t max_pixels,
                          const Location& where) {
    const PixelWindow window{
        pixels_between(box_m.min().y(), box_m.max().y(), grid.y_m, grid.row_m, image.height),
        pixels_between(box_m.min().x(), box_m.max().x(), grid.x_m, grid.column_m, image.width)};
    if (window.width() * window.height() <= max_pixels) return window;
    refuse(where,
           "the mission needs {} x {} pixels of it, and at most {} have room; make it coarser with "
           "gdal_translate -outsize 50% 50%, or cut a part out with gdal_translate -projwin",
           window.width(), window.height(), max_pixels);
}

}  // namespace sonarsim
