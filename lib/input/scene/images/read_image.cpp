#include "input/scene/images/read_image.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/file.h"
#include "core/module.h"
#include "core/text.h"
#include "input/scene/images/module.h"

namespace sonarsim {

namespace {

std::string first_bytes(const std::filesystem::path& path) {
    std::string bytes(16, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/// The name that OpenImageIO has for the format of a file; "" if it is none of those that are read.
std::string image_format(std::string_view bytes) {
    using namespace std::literals;
    if (bytes.starts_with("\x89PNG")) return "png";
    if (bytes.starts_with("\x76\x2f\x31\x01")) return "openexr";
    constexpr std::array tiffs{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
    return contains(tiffs, bytes.substr(0, 4)) ? "tiff" : "";
}

/// InputError unless the path is that of a regular file that can be opened and is not too large.
void require_readable(const std::filesystem::path& path, const Location& where) {
    constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 31;
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) refuse(where, "no such file");
    if (!std::filesystem::is_regular_file(status)) refuse(where, "is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > max_bytes)
        refuse(where, "is larger than 2 GiB; cut a part out with gdal_translate -projwin");
}

struct Reading {
    SonarsimImageHead head;
    Image image;
};

/// Keeps the head of an image. Returns the room for its values, unless they are too many.
float* make_room(void* user, const SonarsimImageHead* head) {
    auto& reading = *static_cast<Reading*>(user);
    reading.head = *head;
    if (head->channels == 0 || head->width > max_row_values / head->channels ||
        head->height > max_image_values ||
        head->width * head->height > max_image_values / head->channels)
        return nullptr;
    reading.image.values.resize(head->width * head->height * head->channels);
    return reading.image.values.data();
}

Reading read_with_module(const std::filesystem::path& path, const std::string& format,
                         const Location& where, SonarsimImageStart start) {
    const auto read = reinterpret_cast<SonarsimReadImage>(
        module_symbol(image_module, image_module_symbol, "libopenimageio-dev", where));
    std::array<char, 400> error{};
    Reading reading{};
    if (read(format.c_str(), path.c_str(), start, &reading, error.data(), error.size()) == 0)
        return reading;
    std::ranges::replace(error, '\n', ' ');
    refuse(where, "cannot be read: {}", printable(error.data()));
}

/// The world file next to an image, ".tfw", ".tifw" or ".wld" for ".tif"; empty: none.
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

/// Reads the world file next to an image, map.tfw, map.tifw or map.wld for map.tif; nullopt if
/// there is none. InputError if it has not six numbers, or for a grid that is turned.
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

void set_reference(const SonarsimImageHead& head, const std::filesystem::path& path,
                   const Location& where, Image& image) {
    image.grid = head.has_grid == 0
                     ? read_world_file(path)
                     : PixelGrid{head.grid[0], head.grid[1], head.grid[2], head.grid[3]};
    image.unit = static_cast<Image::Unit>(head.unit);
    image.heights_in_feet = head.heights_in_feet != 0;
    if (!image.grid) return;
    const auto& [x_m, y_m, column_m, row_m] = *image.grid;
    if (std::isfinite(x_m + y_m + column_m + row_m) && column_m != 0.0 && row_m != 0.0) return;
    refuse(where, "has no valid pixel size or origin; export it again");
}

/// Makes the pixels that have no value NaN. Many files mark them with the largest float, but write
/// this mark with few digits: then every huge value with the sign of the mark is unknown.
void mark_unknown(const SonarsimImageHead& head, const Location& where, Image& image) {
    const std::string_view text = trim(head.no_data);
    if (text.empty()) return;
    const std::optional<double> mark = parse_number(text);
    if (!mark) {
        refuse(where,
               "has the mark of unknown pixels '{}' (GDAL_NODATA), which is not a number; set it "
               "again, as with gdal_translate -a_nodata -9999",
               printable(text));
    }
    if (std::isnan(*mark)) return;
    image.has_no_data = true;
    constexpr double huge = 1e30;
    const auto is_unknown = [&](float value) {
        return std::isnan(value) || value == static_cast<float>(*mark) ||
               (std::fabs(*mark) > huge && std::fabs(value) > huge &&
                (value < 0.0F) == (*mark < 0.0));
    };
    for (std::size_t i = 0; i < image.values.size(); i += head.channels) {
        float* const pixel = &image.values[i];
        if (std::all_of(pixel, pixel + image.colours(), is_unknown))
            std::fill(pixel, pixel + image.colours(), std::nanf(""));
    }
}

/// The pixels from `low` to `high`, with a margin, of `count` from `start` on; or all, not one.
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

bool is_image_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) &&
           !image_format(first_bytes(path)).empty();
}

Image read_image(const std::filesystem::path& path) {
    const Location where{path.string()};
    require_readable(path, where);
    const std::string bytes = first_bytes(path);
    const std::string format = image_format(bytes);
    if (format.empty()) {
        const std::string_view known = known_format(bytes);
        refuse(where, "is {}; PNG, TIFF and OpenEXR are read",
               known.empty() ? "not an image" : known);
    }
    Reading reading = read_with_module(path, format, where, &make_room);
    const SonarsimImageHead& head = reading.head;
    if (reading.image.values.empty()) {
        refuse(where,
               "has {} x {} pixels of {} value{}, and at most 2^26 values are read, 2^22 of a row; "
               "make it coarser with gdal_translate -outsize 50% 50%, or cut a part out with "
               "gdal_translate -projwin",
               head.width, head.height, head.channels, head.channels == 1 ? "" : "s");
    }
    Image& image = reading.image;
    image.width = static_cast<int>(head.width);
    image.height = static_cast<int>(head.height);
    image.channels = static_cast<int>(head.channels);
    image.bits = static_cast<int>(head.bits);
    image.is_float = head.is_float != 0;
    set_reference(head, path, where, image);
    mark_unknown(head, where, image);
    return std::move(image);
}

int epsg_of(const std::filesystem::path& path) {
    const Location where{path.string()};
    require_readable(path, where);
    const std::string format = image_format(first_bytes(path));
    if (format != "tiff") return 0;
    const SonarsimImageStart keep_head = [](void* user, const SonarsimImageHead* head) -> float* {
        static_cast<Reading*>(user)->head = *head;
        return nullptr;
    };
    return static_cast<int>(read_with_module(path, format, where, keep_head).head.epsg);
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
    if (image.unit == Image::Unit::unnamed) {
        refuse(where,
               "does not name the unit of length of its reference system; make a map in metres of "
               "it, as with gdalwarp -t_srs EPSG:32632, or write {}.pixel_m",
               section);
    }
    if (image.unit == Image::Unit::degree) {
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
