#include "scene/images/read_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/known_format.h"
#include "core/module.h"
#include "core/text.h"
#include "scene/images/module.h"
#include "scene/images/world_file.h"

namespace sonarsim {

namespace {

constexpr std::uintmax_t most_image_bytes = std::uintmax_t{1} << 31;

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
    return std::ranges::find(tiffs, bytes.substr(0, 4)) == tiffs.end() ? "" : "tiff";
}

/// InputError unless the path is that of a regular file that can be opened and is not too large.
void require_readable(const std::filesystem::path& path, const Location& where) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(where, "no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(where, "is not a regular file");
    if (!std::ifstream(path, std::ios::binary)) throw InputError(where, "cannot be opened");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > most_image_bytes)
        throw InputError(where,
                         "is larger than 2 GiB; cut a part out with gdal_translate -projwin");
}

[[noreturn]] void refuse_format(std::string_view bytes, const Location& where) {
    if (bytes.starts_with("\xff\xd8\xff"))
        throw InputError(where,
                         "is a JPEG, whose values are not exact; save the image it was made from "
                         "as PNG, TIFF or OpenEXR");
    const std::string_view known = known_format(bytes);
    throw InputError(where, (known.empty() ? "is not an image" : "is " + std::string(known)) +
                                "; PNG, TIFF and OpenEXR are read");
}

struct Reading {
    SonarsimImageHead head;
    Image image;
};

bool has_too_many(const SonarsimImageHead& head) {
    return head.channels == 0 || head.width > most_image_values ||
           head.height > most_image_values ||
           head.width * head.height > most_image_values / head.channels;
}

/// Keeps the head of an image. Returns the room for its values, unless they are too many.
float* make_room(void* user, const SonarsimImageHead* head) {
    auto& reading = *static_cast<Reading*>(user);
    reading.head = *head;
    if (has_too_many(*head)) return nullptr;
    reading.image.values.resize(head->width * head->height * head->channels);
    return reading.image.values.data();
}

/// Reads the pixels and the head of a file.
Reading read_file_with_module(const std::filesystem::path& path, const std::string& format,
                              const Location& where) {
    std::array<char, 400> error{};
    Reading reading{};
    std::string reason;
    try {
        const auto read = reinterpret_cast<SonarsimReadImage>(
            module_symbol(image_module, image_module_symbol, image_package));
        if (read(format.c_str(), path.c_str(), &make_room, &reading, error.data(), error.size()) !=
            0)
            reason = error.data();
    } catch (const InputError& fault) {
        reason = fault.what();
    }
    std::ranges::replace(reason, '\n', ' ');
    if (!reason.empty()) throw InputError(where, "cannot be read: " + printable(reason));
    return reading;
}

void set_reference(const SonarsimImageHead& head, const std::filesystem::path& path,
                   const Location& where, Image& image) {
    if (head.has_grid != 0)
        image.grid = PixelGrid{head.grid[0], head.grid[1], head.grid[2], head.grid[3]};
    else
        image.grid = read_world_file(path);
    image.in_degrees = head.in_degrees != 0;
    if (image.grid) {
        const PixelGrid& grid = *image.grid;
        const bool holds = std::isfinite(grid.x_m) && std::isfinite(grid.y_m) &&
                           std::isfinite(grid.column_m) && std::isfinite(grid.row_m) &&
                           grid.column_m != 0.0 && grid.row_m != 0.0;
        if (!holds) throw InputError(where, "has no valid pixel size or origin; export it again");
    }
    const std::string_view no_data = trim(head.no_data);
    if (no_data.empty()) return;
    image.no_data = parse_number(no_data);
    if (!image.no_data) {
        throw InputError(where, "has the mark of unknown pixels '" + printable(no_data) +
                                    "' (GDAL_NODATA), which is not a number; set it anew, as with "
                                    "gdal_translate -a_nodata -9999");
    }
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
    if (format.empty()) refuse_format(bytes, where);
    Reading reading = read_file_with_module(path, format, where);
    const SonarsimImageHead& head = reading.head;
    if (has_too_many(head)) {
        throw InputError(where, "has " + std::to_string(head.width) + " x " +
                                    std::to_string(head.height) + " pixels of " +
                                    std::to_string(head.channels) +
                                    (head.channels == 1 ? " value" : " values") +
                                    ", and at most 2^26 values are read; make it coarser with "
                                    "gdal_translate -outsize 50% 50%, or cut a part out with "
                                    "gdal_translate -projwin");
    }
    Image& image = reading.image;
    image.width = static_cast<int>(head.width);
    image.height = static_cast<int>(head.height);
    image.channels = static_cast<int>(head.channels);
    image.bits = static_cast<int>(head.bits);
    image.is_float = head.is_float != 0;
    set_reference(head, path, where, image);
    return std::move(image);
}

}  // namespace sonarsim
